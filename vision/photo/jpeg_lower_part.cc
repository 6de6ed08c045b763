// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/jpeg_lower_part.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>
// jpeglib.h needs FILE and size_t declared before it.
#include <jpeglib.h>

#include "vision/photo/bit_reader.h"
#include "vision/photo/huffman_codes.h"

namespace bladecurve {
namespace {

// The blocks of one colour plane in each MCU, and their codes.
struct Component {
  int blocks = 0;
  std::shared_ptr<const HuffmanCodes> dc;
  std::shared_ptr<const AcCodes> ac;
};

HuffmanTable TableOf(const JHUFF_TBL& stored) { return {stored.bits, stored.huffval}; }

std::vector<Component> ComponentsOf(const jpeg_decompress_struct& info) {
  std::array<std::shared_ptr<const HuffmanCodes>, NUM_HUFF_TBLS> dc;
  std::array<std::shared_ptr<const AcCodes>, NUM_HUFF_TBLS> ac;
  std::vector<Component> components;
  for (int i = 0; i < info.comps_in_scan; ++i) {
    const jpeg_component_info& stored = *info.cur_comp_info[i];
    const auto d = static_cast<size_t>(stored.dc_tbl_no), a = static_cast<size_t>(stored.ac_tbl_no);
    if (!dc[d]) dc[d] = std::make_shared<const HuffmanCodes>(TableOf(*info.dc_huff_tbl_ptrs[d]));
    if (!ac[a]) ac[a] = std::make_shared<const AcCodes>(TableOf(*info.ac_huff_tbl_ptrs[a]));
    components.push_back({stored.MCU_blocks, dc[d], ac[a]});
  }
  return components;
}

constexpr int kLargestSize = 15;  // of a value, bits

// The first `size` bits of a window as a value (ITU-T T.81, F.2.2.1), without a branch: signs are
// hard to foresee.
int Extended(std::uint64_t window, int size) {
  const int read = static_cast<int>(window >> 1U >> static_cast<unsigned>(63 - size));
  const int half = (1 << size) >> 1;
  return read - static_cast<int>(read < half) * ((1 << size) - 1);
}

// Goes behind the next block and adds its difference to `dc`; false where there is no such code.
bool CountBlock(const Component& component, BitReader* reader, std::int64_t* dc) {
  const std::uint64_t window = reader->Window();
  const HuffmanCodes::Code code = component.dc->At(window);
  const int size = code.symbol;  // at most kLargestSize: libjpeg takes no other tables
  if (code.bits == 0) return false;
  *dc += Extended(window << code.bits, size);
  reader->Skip(code.bits + size);
  for (int coefficient = 1; coefficient < DCTSIZE2;) {
    AcCodes::Step step = component.ac->StepsAt(reader->Window());
    // A code may be long, and a full block has no code for its end: what looks like one is not.
    if (step.bits == 0 || coefficient + step.coefficients % AcCodes::kToBlockEnd >= DCTSIZE2)
      step = component.ac->StepAt(reader->Window());
    if (step.bits == 0) return false;
    reader->Skip(step.bits);
    coefficient += step.coefficients;
  }
  return true;
}

// Entropy-coded data, with zeros stuffed behind bytes of 255 as BitReader leaves them out.
class BitWriter {
 public:
  void Write(unsigned value, int bits) {
    for (int i = bits - 1; i >= 0; --i) {
      byte_ = byte_ << 1U | (value >> static_cast<unsigned>(i) & 1U);
      if (++bits_ % 8 != 0) continue;
      data_ += static_cast<char>(byte_ & 0xffU);
      if ((byte_ & 0xffU) == 0xff) data_ += '\0';
    }
  }
  [[nodiscard]] int bits() const { return bits_; }
  [[nodiscard]] const std::string& data() const { return data_; }  // whole bytes

 private:
  std::string data_;
  unsigned byte_ = 0;
  int bits_ = 0;
};

// Where a row of MCUs begins, and the DC values just before.
struct Entry {
  BitReader::Place place;
  std::vector<std::int64_t> dc;  // of each component; whatever damaged codes add up to
};

std::optional<Entry> EntryBehind(std::string_view data,
                                 const std::vector<Component>& components,
                                 int mcus) {
  BitReader reader(data);
  std::vector<std::int64_t> dc(components.size());
  for (int mcu = 0; mcu < mcus; ++mcu) {
    for (size_t i = 0; i < components.size(); ++i) {
      for (int block = 0; block < components[i].blocks; ++block) {
        if (!CountBlock(components[i], &reader, &dc[i])) return std::nullopt;
      }
    }
    if (reader.ran_out()) return std::nullopt;
  }
  return Entry{reader.At(), std::move(dc)};
}

// The greatest difference towards `rest` that the table has a code for.
int DifferenceTowards(std::int64_t rest, const HuffmanCodes& dc) {
  const auto magnitude = static_cast<std::uint64_t>(std::abs(rest));
  for (int size = std::min<int>(std::bit_width(magnitude), kLargestSize); size > 0; --size) {
    const auto difference = static_cast<int>(
        std::min<std::uint64_t>(magnitude, (1U << static_cast<unsigned>(size)) - 1));
    if (dc.Of(size).bits > 0) return rest < 0 ? -difference : difference;
  }
  return 0;
}

// A code and the value behind it, whose size its symbol's lower half is.
void WriteValue(int value, const HuffmanCodes::Code& code, BitWriter* writer) {
  const int size = code.symbol & 15;
  writer->Write(code.code, code.bits);
  writer->Write(static_cast<unsigned>(value < 0 ? value + (1 << size) - 1 : value), size);
}

// Any code that lengthens a block by an odd number of bits and does not end it.
HuffmanCodes::Code OddCode(const HuffmanCodes& ac) {
  for (int symbol = 1; symbol < 256; ++symbol) {
    const HuffmanCodes::Code code = ac.Of(symbol);
    const AcCodes::Step step = AcCodes::StepOf(code);
    if (step.bits % 2 == 1 && step.coefficients < AcCodes::kToBlockEnd) return code;
  }
  return {};
}

// A row of MCUs after which the DC values are `dc`, its first blocks `lengthened` by odd codes.
// Nothing where the tables do not allow it.
std::optional<BitWriter> LeadingRow(const std::vector<Component>& components,
                                    int mcus,
                                    std::vector<std::int64_t> dc,
                                    int lengthened) {
  const HuffmanCodes::Code odd = OddCode(components.front().ac->codes());
  BitWriter row;
  for (int mcu = 0; mcu < mcus; ++mcu) {
    for (size_t i = 0; i < components.size(); ++i) {
      const HuffmanCodes& dc_codes = *components[i].dc;
      const HuffmanCodes::Code end = components[i].ac->codes().Of(AcCodes::kEndOfBlock);
      for (int block = 0; block < components[i].blocks; ++block) {
        const int difference = DifferenceTowards(dc[i], dc_codes);
        const auto size = std::bit_width(static_cast<unsigned>(std::abs(difference)));
        const HuffmanCodes::Code code = dc_codes.Of(static_cast<int>(size));
        if (code.bits == 0 || end.bits == 0) return std::nullopt;
        WriteValue(difference, code, &row);
        dc[i] -= difference;
        if (i == 0 && lengthened > 0) {
          WriteValue(0, odd, &row);
          --lengthened;
        }
        row.Write(end.code, end.bits);
      }
    }
  }
  const bool reached =
      std::all_of(dc.begin(), dc.end(), [](std::int64_t rest) { return rest == 0; });
  if (!reached || lengthened > 0) return std::nullopt;
  return row;
}

// The same, and so long that the row behind goes on at the bit where it begins in its byte.
std::optional<BitWriter> FittingRow(const std::vector<Component>& components,
                                    int mcus,
                                    const Entry& entry) {
  for (int lengthened = 0; lengthened < 8; ++lengthened) {
    std::optional<BitWriter> row = LeadingRow(components, mcus, entry.dc, lengthened);
    if (!row || row->bits() % 8 == entry.place.bits) return row;
  }
  return std::nullopt;
}

// Where the frame header begins (SOF0 or SOF1; ITU-T T.81, B.2.2).
std::optional<size_t> FrameHeader(std::string_view bytes) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
  for (size_t i = 2; i + 9 < bytes.size() && byte(i) == 0xff;) {
    const int marker = byte(i + 1);
    if (marker == 0xc0 || marker == 0xc1) return i;
    i += marker == 0xff ? 1 : 2 + 256U * byte(i + 2) + byte(i + 3);
  }
  return std::nullopt;
}

// Everything before the codes, for a picture of so many rows.
std::optional<std::string> HeaderFor(std::string_view header, int rows) {
  const std::optional<size_t> frame = FrameHeader(header);
  if (!frame) return std::nullopt;
  std::string changed(header);
  changed[*frame + 5] = static_cast<char>(rows / 256);
  changed[*frame + 6] = static_cast<char>(rows % 256);
  return changed;
}

}  // namespace

int McuRowHeight(const jpeg_decompress_struct& info) {
  return DCTSIZE * (info.comps_in_scan == 1 ? 1 : info.max_v_samp_factor);
}

bool HasCountableCodes(const jpeg_decompress_struct& info) {
  return info.arith_code == FALSE && info.progressive_mode == FALSE && info.restart_interval == 0;
}

std::optional<std::string> LowerPartOfJpeg(std::string_view bytes,
                                           const jpeg_decompress_struct& info,
                                           int first_mcu_row) {
  if (!HasCountableCodes(info)) return std::nullopt;
  const int mcus_per_row = static_cast<int>(info.MCUs_per_row);
  const size_t header_size = bytes.size() - info.src->bytes_in_buffer;
  const std::string_view data = bytes.substr(header_size);
  const std::vector<Component> components = ComponentsOf(info);
  const std::optional<Entry> entry = EntryBehind(data, components, first_mcu_row * mcus_per_row);
  if (!entry) return std::nullopt;
  const int rows = static_cast<int>(info.image_height) - (first_mcu_row - 1) * McuRowHeight(info);
  std::optional<std::string> part = HeaderFor(bytes.substr(0, header_size), rows);
  std::optional<BitWriter> leading = FittingRow(components, mcus_per_row, *entry);
  if (!part || !leading) return std::nullopt;
  size_t next = entry->place.byte;
  if (entry->place.bits > 0) {  // the two share a byte
    const auto shared = static_cast<unsigned char>(data[next]);
    leading->Write(shared, 8 - entry->place.bits);
    next += shared == 0xff ? 2 : 1;
  }
  part->append(leading->data()).append(data.substr(next));
  return part;
}

}  // namespace bladecurve

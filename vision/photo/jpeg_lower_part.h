// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

struct jpeg_decompress_struct;

namespace bladecurve {

// A row of MCUs (ITU-T T.81, A.2.3): 8 rows of pixels, or 16 where colour is halved downwards.
[[nodiscard]] int McuRowHeight(const jpeg_decompress_struct& info);

// Whether LowerPartOfJpeg knows the codes: Huffman's, in one sequential scan without restart
// markers.
[[nodiscard]] bool HasCountableCodes(const jpeg_decompress_struct& info);

// A JPEG file whose first row of MCUs means nothing and whose further ones are those of `bytes`
// from `first_mcu_row` on, code for code. Huffman codes cannot be entered half-way, but those
// before are only counted here, in a fifth of the time that decoding them takes. `info` has read
// the header of `bytes` and started decompressing, but has not asked for a row. Nothing where the
// codes are of another kind or damaged before that row, or where the tables have none for the first
// row.
[[nodiscard]] std::optional<std::string> LowerPartOfJpeg(std::string_view bytes,
                                                         const jpeg_decompress_struct& info,
                                                         int first_mcu_row);

}  // namespace bladecurve

// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/refusal.h"

#include <nlohmann/json.hpp>

namespace bladecurve {

std::string RefusalText(const Refused& refusal, const std::string& photo) {
  const nlohmann::ordered_json record = {{"format", "bladecurve/1"},
                                         {"status", "refused"},
                                         {"reason", ReasonCode(refusal.reason())},
                                         {"detail", refusal.what()},
                                         {"photo", photo}};
  // File names need not be UTF-8; replacing what is not keeps the line valid JSON.
  return record.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace bladecurve

// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace bladecurve {

// One of the files that every plugin is made of, as it was when this library was built.
struct PluginPart {
  std::string_view name;
  std::string_view text;
};

inline constexpr std::size_t kNumPluginParts = 7;

// blade_plugin.h, the kernel_*.h in the order they need each other, plugin_body.c.
extern const std::array<PluginPart, kNumPluginParts> kPluginParts;

}  // namespace bladecurve

# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
# cmake -DOUTPUT=FILE.cc -DINPUTS="a|b|.." -P embed_text.cmake
# Writes the texts of the plugin's parts, in that order, as one C++ constant kPluginParts.
string(REPLACE "|" ";" inputs "${INPUTS}")
set(text "// Generated from ${INPUTS}; do not edit.\n#include \"model/plugin_parts.h\"\n\nnamespace bladecurve {\n\n")
string(APPEND text "const std::array<PluginPart, kNumPluginParts> kPluginParts = {{\n")
foreach(input IN LISTS inputs)
  get_filename_component(name "${input}" NAME)
  file(READ "${input}" part)
  string(APPEND text "{\"${name}\", R\"part(${part})part\"},\n")
endforeach()
string(APPEND text "}};\n\n}  // namespace bladecurve\n")
file(WRITE "${OUTPUT}" "${text}")

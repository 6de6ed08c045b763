# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
# Puts samples/materials/*.json into the program bladecurve (material_choice.cc.in).
set(shipped_materials "")
foreach(name paper plastic cloth chicken-skin)
  set(file ${CMAKE_CURRENT_SOURCE_DIR}/materials/${name}.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(APPEND shipped_materials "    {\"${name}\", R\"json(${text})json\"},\n")
endforeach()
configure_file(material_choice.cc.in ${CMAKE_CURRENT_BINARY_DIR}/material_choice.cc @ONLY)
target_sources(bladecurve_program PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/material_choice.cc)

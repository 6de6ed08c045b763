# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
# cmake -DVALGRIND=<program> -DSTEPS=<torque_steps> -DWHAT=closing|anything -DMOST=<bound> -DWORK=<scratch>
#   -P count_instructions.cmake
# Counts the instructions of every step (callgrind) and fails if one takes more than MOST. What is counted does not
# depend on the machine's speed or load.
if(NOT VALGRIND)
  message("skipped: no valgrind")
  return()
endif()
set(step "bladecurve::TorqueModel::Step(double, double, double)")
set(counts ${WORK}/callgrind.${WHAT}.out)
file(MAKE_DIRECTORY ${WORK})
file(REMOVE ${counts})
execute_process(
  COMMAND ${VALGRIND} --tool=callgrind --callgrind-out-file=${counts} --combine-dumps=yes --toggle-collect=${step}
          --dump-after=${step} ${STEPS} ${WHAT}
  RESULT_VARIABLE result
  OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "valgrind failed with ${result}:\n${output}")
endif()
file(STRINGS ${counts} totals REGEX "^totals: ")
list(TRANSFORM totals REPLACE "^totals: " "")
list(SORT totals COMPARE NATURAL)
list(LENGTH totals number)
if(number LESS 1000)
  message(FATAL_ERROR "only ${number} steps were counted")
endif()
math(EXPR middle "${number} / 2")
list(GET totals ${middle} median)
list(GET totals -1 most)
message("${WHAT}: ${number} steps, median ${median}, most ${most} instructions (bound ${MOST})")
if(most GREATER MOST)
  message(FATAL_ERROR "a step took ${most} instructions")
endif()

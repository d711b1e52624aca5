# SPDX-License-Identifier: Apache-2.0
# Tests of the command line (tests/cli/*.sh, *.py), the baseline of bench, and of the source tree. Exit code 77 means
# skipped.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

if(TARGET brdf-compress)
  file(GLOB scripts CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/cli/*.sh" "${CMAKE_CURRENT_SOURCE_DIR}/cli/*.py")
  foreach(script IN LISTS scripts)
    cmake_path(GET script STEM name)
    cmake_path(GET script EXTENSION extension)
    if(extension STREQUAL ".py")
      set(runner "${Python3_EXECUTABLE}")
    else()
      set(runner bash)
    endif()
    add_test(NAME cli.${name} COMMAND ${runner} "${script}")
    set_tests_properties(cli.${name} PROPERTIES LABELS cli SKIP_RETURN_CODE 77
      ENVIRONMENT "${test_environment};PYTHONPATH=${CMAKE_CURRENT_SOURCE_DIR};PYTHONDONTWRITEBYTECODE=1")
  endforeach()
endif()

if(TARGET brdfd AND TARGET brdf-query AND TARGET brdf-gonio)
  file(GLOB scripts CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/server/*_script.py")
  foreach(script IN LISTS scripts)
    cmake_path(GET script STEM name)
    add_test(NAME server.${name} COMMAND "${Python3_EXECUTABLE}" "${script}")
    set_tests_properties(server.${name} PROPERTIES LABELS server SKIP_RETURN_CODE 77
      ENVIRONMENT "${test_environment};PYTHONPATH=${CMAKE_CURRENT_SOURCE_DIR};PYTHONDONTWRITEBYTECODE=1")
  endforeach()
endif()

if(TARGET brdf-compress AND TARGET brdf-gonio)
  add_test(NAME bench.baseline COMMAND "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_SOURCE_DIR}/bench/baseline.py")
  set_tests_properties(bench.baseline PROPERTIES LABELS bench RUN_SERIAL TRUE ENVIRONMENT "${test_environment}")
endif()

if(TARGET brdf_extremes_tests)
  add_test(NAME source.numerics_page
    COMMAND "${Python3_EXECUTABLE}" "${PROJECT_SOURCE_DIR}/tools/measure-numerics" --check $<TARGET_FILE:brdf_extremes_tests>)
  set_tests_properties(source.numerics_page PROPERTIES LABELS source)
endif()

set(check_includes "${CMAKE_CURRENT_SOURCE_DIR}/support/check_includes.py")
add_test(NAME source.rules COMMAND "${Python3_EXECUTABLE}" "${check_includes}" "${PROJECT_SOURCE_DIR}")
add_test(NAME source.rules_catch_violations COMMAND "${Python3_EXECUTABLE}" "${check_includes}" --self-test)
set_tests_properties(source.rules source.rules_catch_violations PROPERTIES LABELS source)

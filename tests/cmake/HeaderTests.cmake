# SPDX-License-Identifier: Apache-2.0
# Every header compiles on its own, and twice: one generated file per header that includes it first.
# Not under sanitizers: there is nothing to run.
if(BRDF_SANITIZE)
  return()
endif()

set(include_roots "${PROJECT_SOURCE_DIR}/libbrdf/include" "${PROJECT_SOURCE_DIR}/libbrdf/src")
file(GLOB headers CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/libbrdf/include/brdf/*.h" "${PROJECT_SOURCE_DIR}/libbrdf/src/*/*.h")
list(FILTER headers EXCLUDE REGEX "-inl\\.h$")  # Highway's per-target bodies are no headers in that sense

set(header_sources)
foreach(header IN LISTS headers)
  set(name "${header}")
  foreach(root IN LISTS include_roots)
    string(REPLACE "${root}/" "" name "${name}")
  endforeach()
  string(MAKE_C_IDENTIFIER "${name}" file)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/headers/${file}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "#include <${name}>\n#include <${name}>\n")
  list(APPEND header_sources "${source}")
endforeach()

add_library(brdf_header_tests OBJECT ${header_sources})
brdf_compile_options(brdf_header_tests)
target_link_libraries(brdf_header_tests PRIVATE brdf_test_base)

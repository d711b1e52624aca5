# SPDX-License-Identifier: Apache-2.0
# Every public header compiles on its own, and twice: one generated file per header that includes it first.
file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/libbrdf/include/brdf/*.h")

set(header_sources)
foreach(header IN LISTS headers)
  cmake_path(GET header FILENAME name)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "#include <brdf/${name}>\n#include <brdf/${name}>\n")
  list(APPEND header_sources "${source}")
endforeach()

add_library(brdf_header_tests OBJECT ${header_sources})
brdf_compile_options(brdf_header_tests)
target_link_libraries(brdf_header_tests PRIVATE brdf::decode)  # no internal include folder, and no Ceres

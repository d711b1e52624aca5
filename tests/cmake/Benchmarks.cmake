# SPDX-License-Identifier: Apache-2.0
# One Google Benchmark program per file of tests/bench.
find_package(benchmark REQUIRED)
file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/bench/*.cpp")
foreach(source IN LISTS sources)
  cmake_path(GET source STEM name)
  add_executable(bench_${name} "${source}")
  brdf_compile_options(bench_${name})
  target_link_libraries(bench_${name} PRIVATE ${test_libraries} benchmark::benchmark_main)
endforeach()

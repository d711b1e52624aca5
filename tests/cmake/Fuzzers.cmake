# SPDX-License-Identifier: Apache-2.0
# Each file defines LLVMFuzzerTestOneInput. Every build replays the committed corpus; with BRDF_BUILD_FUZZERS the same
# files are real fuzzers that also search for BRDF_FUZZ_SECONDS.
file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/*.cpp")
list(FILTER sources EXCLUDE REGEX "/replay_main\\.cpp$")
if(NOT TARGET brdf_daemon)
  list(FILTER sources EXCLUDE REGEX "/(requests|service_texts)\\.cpp$")
endif()

if(BRDF_BUILD_FUZZERS)
  # Comparisons of numbers tell a fuzzer nothing about what to write into a table, and reporting them to it takes half of the
  # time of an encode.
  file(GLOB numeric CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/libbrdf/src/fit/*.cpp" "${PROJECT_SOURCE_DIR}/libbrdf/src/metrics/*.cpp"
    "${PROJECT_SOURCE_DIR}/libbrdf/src/encode/*.cpp")
  set_property(SOURCE ${numeric} TARGET_DIRECTORY brdf APPEND PROPERTY COMPILE_OPTIONS -fno-sanitize-coverage=trace-cmp)
endif()

foreach(source IN LISTS sources)
  cmake_path(GET source STEM name)
  set(program fuzz_${name})
  set(corpus "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${name}")
  add_executable(${program} "${source}")
  brdf_compile_options(${program})
  target_link_libraries(${program} PRIVATE ${test_libraries})
  if(BRDF_BUILD_FUZZERS)
    target_link_options(${program} PRIVATE -fsanitize=fuzzer)
    # New findings go to a folder of the build; the committed corpus is only read.
    set(found "${CMAKE_CURRENT_BINARY_DIR}/fuzz-found/${name}")
    file(MAKE_DIRECTORY "${found}")
    set(limits -rss_limit_mb=2048 -timeout=60 "-artifact_prefix=${found}-")
    if(IS_DIRECTORY "${corpus}")
      add_test(NAME fuzz.${name}.replay COMMAND ${program} ${limits} -runs=0 "${corpus}")
      set_tests_properties(fuzz.${name}.replay PROPERTIES LABELS fuzz)
      set(seeds "${corpus}")
    else()
      set(seeds)
    endif()
    add_test(NAME fuzz.${name}.search
      COMMAND ${program} ${limits} -max_total_time=${BRDF_FUZZ_SECONDS} -print_final_stats=1 "${found}" ${seeds})
    set_tests_properties(fuzz.${name}.search PROPERTIES LABELS fuzz)
  else()
    target_sources(${program} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/replay_main.cpp")
    if(IS_DIRECTORY "${corpus}")
      add_test(NAME fuzz.${name}.replay COMMAND ${program} "${corpus}")
      set_tests_properties(fuzz.${name}.replay PROPERTIES LABELS fuzz)
    endif()
  endif()
endforeach()
if(TARGET brdf_daemon)
  foreach(program IN ITEMS fuzz_requests fuzz_service_texts)
    target_link_libraries(${program} PRIVATE brdf_daemon)
  endforeach()
endif()

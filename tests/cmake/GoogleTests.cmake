# SPDX-License-Identifier: Apache-2.0
# One GoogleTest program per folder.
include(GoogleTest)
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)

function(brdf_discover program folder)
  set(common DISCOVERY_MODE PRE_TEST WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" TEST_PREFIX "${folder}.")
  gtest_discover_tests(${program} ${common} TEST_FILTER "-*Slow*" TEST_LIST ${program}_quick)
  gtest_discover_tests(${program} ${common} TEST_FILTER "*Slow*" TEST_LIST ${program}_slow)
  # gtest_discover_tests passes no property whose value is a list, so CTest reads them from a file of its own.
  set(properties "${CMAKE_CURRENT_BINARY_DIR}/${program}_properties.cmake")
  file(GENERATE OUTPUT "${properties}" CONTENT "
foreach(test IN LISTS ${program}_quick ${program}_slow)
  set_tests_properties(\"\${test}\" PROPERTIES LABELS ${folder} ENVIRONMENT \"${test_environment}\")
endforeach()
foreach(test IN LISTS ${program}_slow)
  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${folder};slow\")
endforeach()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${properties}")
endfunction()

foreach(folder IN ITEMS unit property extremes golden negative)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp")
  if(sources)
    set(program brdf_${folder}_tests)
    add_executable(${program} ${sources})
    brdf_compile_options(${program})
    target_link_libraries(${program} PRIVATE ${test_libraries} rapidcheck_gtest GTest::gtest_main)
    brdf_discover(${program} ${folder})
  endif()
endforeach()

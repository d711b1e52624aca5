# SPDX-License-Identifier: Apache-2.0
# brdf-load: the daemon under load. Its short form runs with the integration tests; docs/server.md says how to run the long one.
find_package(CLI11 REQUIRED)
file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/server/load/*.cpp")
add_executable(brdf-load ${sources})
brdf_compile_options(brdf-load)
brdf_precompile(brdf-load <brdf/v1/brdf_service.grpc.pb.h> <grpcpp/grpcpp.h>)
set_target_properties(brdf-load PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
target_include_directories(brdf-load PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/libbrdf/src")
target_link_libraries(brdf-load PRIVATE brdf_client brdf::brdf CLI11::CLI11)
add_dependencies(brdf-load brdfd brdf-compress brdf-gonio)

# One test a row, so that a failure has a name. They take two processors for themselves: nothing else runs beside them.
if(BRDF_BUILD_TESTS)
  foreach(row IN ITEMS throughput small-call fetch overload replicas swaps hostile flood compress soak)
    add_test(NAME load.${row} COMMAND brdf-load ${row})
    set_tests_properties(load.${row} PROPERTIES LABELS soak RUN_SERIAL TRUE TIMEOUT 300 ENVIRONMENT "${test_environment}")
  endforeach()
endif()

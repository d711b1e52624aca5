# SPDX-License-Identifier: Apache-2.0
# What installs or runs the whole product. Not under sanitizers: the outside consumer is built without them.
if(BRDF_SANITIZE OR NOT BRDF_INSTALL)
  return()
endif()

add_test(NAME integration.consumer COMMAND bash "${CMAKE_CURRENT_SOURCE_DIR}/consumer/check_installed_tree.sh"
  "${PROJECT_BINARY_DIR}" "${CMAKE_CXX_COMPILER}")
add_test(NAME integration.minimal_build COMMAND bash "${CMAKE_CURRENT_SOURCE_DIR}/consumer/check_minimal_build.sh"
  "${PROJECT_SOURCE_DIR}" "${CMAKE_CXX_COMPILER}")
if(TARGET brdf-compress AND TARGET brdf-gonio)
  add_test(NAME integration.quickstart COMMAND bash "${PROJECT_SOURCE_DIR}/tools/quickstart")
  set_tests_properties(integration.quickstart PROPERTIES LABELS integration TIMEOUT 1200)
endif()
set_tests_properties(integration.consumer integration.minimal_build PROPERTIES LABELS integration)

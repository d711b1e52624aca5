# SPDX-License-Identifier: Apache-2.0
# brdf::client for find_package(brdf COMPONENTS client): static libraries, because the messages are a matter of the protobuf that the
# client itself is built with. The export set is its own, so that nobody else looks for gRPC.
set_target_properties(brdf_client PROPERTIES EXPORT_NAME client)
set_target_properties(brdf_server_shared PROPERTIES EXPORT_NAME client_shared OUTPUT_NAME brdf_client_shared)
set_target_properties(brdf_proto PROPERTIES EXPORT_NAME client_proto OUTPUT_NAME brdf_client_proto)
install(TARGETS brdf_client brdf_server_shared brdf_proto EXPORT brdf-client ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT brdf-client NAMESPACE brdf:: FILE brdf-client-targets.cmake DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/brdf")
install(DIRECTORY client/include/brdf DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h")
install(DIRECTORY "${generated}/brdf" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.pb.h")
install(DIRECTORY proto/brdf DESTINATION "${CMAKE_INSTALL_DATADIR}/brdf/proto" FILES_MATCHING PATTERN "*.proto")

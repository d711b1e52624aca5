// SPDX-License-Identifier: Apache-2.0
// Reflection and channelz of the running daemon, as tools that know no proto file ask for them. Neither service has installed headers, so
// the messages are made from the descriptors that gRPC's libraries bring.
#include "server/running_daemon.h"

#include <brdf/v1/admin_service.grpc.pb.h>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <set>

namespace {

using namespace brdf;
using grpc::StatusCode;
using test::Words;

using MessagePointer = std::unique_ptr<google::protobuf::Message>;

MessagePointer message_of(const std::string& type, const std::string& text = {}) {
  const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(type);
  if (descriptor == nullptr) throw std::runtime_error("nothing that is linked knows " + type);
  MessagePointer message(google::protobuf::MessageFactory::generated_factory()->GetPrototype(descriptor)->New());
  if (!google::protobuf::TextFormat::ParseFromString(text, message.get())) throw std::runtime_error(text + " is no " + type);
  return message;
}

struct Answer {
  grpc::Status status;
  MessagePointer message;
};

/// One message there, one back.
Answer exchange(const std::shared_ptr<grpc::Channel>& channel, const std::string& method, const google::protobuf::Message& question, MessagePointer answer) {
  test::Context context;
  grpc::GenericStub stub(channel);
  grpc::CompletionQueue queue;
  const auto wait = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  const auto call = stub.PrepareCall(&context, method, &queue);
  call->StartCall(nullptr);
  wait();
  const std::string wire = question.SerializeAsString();
  const grpc::Slice slice(wire);
  call->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
  wait();
  grpc::ByteBuffer bytes;
  call->Read(&bytes, nullptr);
  if (wait()) {
    grpc::ProtoBufferReader reader(&bytes);
    if (!answer->ParseFromZeroCopyStream(&reader)) throw std::runtime_error("an answer of " + method + " is no message");
  }
  grpc::Status status;
  call->Finish(&status, nullptr);
  wait();
  return {status, std::move(answer)};
}

Answer reflect(const std::shared_ptr<grpc::Channel>& channel, const std::string& question) {
  const std::string package = "grpc.reflection.v1alpha.";
  return exchange(channel, "/" + package + "ServerReflection/ServerReflectionInfo", *message_of(package + "ServerReflectionRequest", question), message_of(package + "ServerReflectionResponse"));
}

std::set<std::string> services_of(const std::shared_ptr<grpc::Channel>& channel) {
  const Answer answer = reflect(channel, "list_services: ''");
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  const std::string text = answer.message->DebugString();
  std::set<std::string> names;
  const std::string mark = "name: \"";
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;) {
    at += mark.size();
    names.insert(text.substr(at, text.find('"', at) - at));
  }
  return names;
}

/// Methods of a service, by the file that the server says holds it.
std::set<std::string> described(const std::shared_ptr<grpc::Channel>& channel, const std::string& service) {
  const Answer answer = reflect(channel, "file_containing_symbol: '" + service + "'");
  std::set<std::string> methods;
  const auto* response = answer.message->GetDescriptor()->FindFieldByName("file_descriptor_response");
  const auto* reflection = answer.message->GetReflection();
  if (!reflection->HasField(*answer.message, response)) return methods;
  const auto& files = reflection->GetMessage(*answer.message, response);
  const auto* field = files.GetDescriptor()->FindFieldByName("file_descriptor_proto");
  for (int i = 0; i < files.GetReflection()->FieldSize(files, field); ++i) {
    google::protobuf::FileDescriptorProto file;
    if (!file.ParseFromString(files.GetReflection()->GetRepeatedString(files, field, i))) continue;
    for (const auto& s : file.service())
      for (const auto& m : s.method())
        if (file.package() + "." + s.name() == service) methods.insert(m.name());
  }
  return methods;
}

TEST(Reflection, DescribesTheServicesAndHealth) {
  test::RunningDaemon d;
  d.start({"--listen", d.socket(), "--admin-listen", "unix:" + d.place("admin"), "--reflection"});
  const auto channel = test::fresh_channel(d.addresses[0]), admin = test::fresh_channel("unix:" + d.place("admin"));
  const std::string reflection = "grpc.reflection.v1alpha.ServerReflection", health = "grpc.health.v1.Health";
  EXPECT_EQ(services_of(channel), (std::set<std::string>{"brdf.v1.BrdfService", health, reflection}));
  EXPECT_EQ(services_of(admin), (std::set<std::string>{"brdf.v1.AdminService", health, reflection}));
  EXPECT_EQ(described(channel, health), (std::set<std::string>{"Check", "Watch"}));
  EXPECT_EQ(described(channel, "brdf.v1.BrdfService").size(), 9U);
  EXPECT_EQ(described(admin, "brdf.v1.AdminService"), (std::set<std::string>{"LoadMaterial", "UnloadMaterial", "ReloadRepository"}));
  EXPECT_TRUE(described(channel, "brdf.v1.NoService").empty());
}

TEST(Reflection, IsOffUnlessAskedFor) {
  test::RunningDaemon d;
  d.start({"--listen", d.socket(), "--admin-listen", "unix:" + d.place("admin"), "--channelz"});
  for (const std::string& address : {d.addresses[0], "unix:" + d.place("admin")})
    EXPECT_EQ(reflect(test::fresh_channel(address), "list_services: ''").status.error_code(), StatusCode::UNIMPLEMENTED) << address;
}

Answer servers_of(const std::shared_ptr<grpc::Channel>& channel) {
  const std::string package = "grpc.channelz.v1.";
  return exchange(channel, "/" + package + "Channelz/GetServers", *message_of(package + "GetServersRequest"), message_of(package + "GetServersResponse"));
}

TEST(Channelz, OnlyOnTheAdminListenerAndOnlyWhenAskedFor) {
  test::RunningDaemon d;
  const Words listen{"--listen", d.socket(), "--admin-listen", "unix:" + d.place("admin")};
  Words with = listen;
  with.push_back("--channelz");
  d.start(with);
  EXPECT_TRUE(test::ask(test::fresh_channel(d.addresses[0])).ok());
  const Answer answer = servers_of(test::fresh_channel("unix:" + d.place("admin")));
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_TRUE(test::says(answer.message->DebugString(), "calls_succeeded: 1"));
  EXPECT_EQ(servers_of(test::fresh_channel(d.addresses[0])).status.error_code(), StatusCode::UNIMPLEMENTED);

  test::RunningDaemon without;
  without.start({"--listen", without.socket(), "--admin-listen", "unix:" + without.place("admin")});
  EXPECT_EQ(servers_of(test::fresh_channel("unix:" + without.place("admin"))).status.error_code(), StatusCode::UNIMPLEMENTED);
}

}  // namespace

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brdfd as a client sees it that shares nothing with it: grpcio in Python, the API learnt through reflection. Skipped unless
$BRDF_RPC_PEERS names an environment with grpcio, grpcio-reflection, grpcio-health-checking and grpcio-status (tests/run --long)."""
import os
import pathlib
import shutil
import subprocess
import struct
import sys
import tempfile
import unittest

SKIPPED = 77
PEERS = os.environ.get("BRDF_RPC_PEERS")
BRDFD = os.environ.get("BRDFD")
if not PEERS or not BRDFD:
    print("BRDF_RPC_PEERS or BRDFD is not set")
    sys.exit(SKIPPED)
PYTHON = pathlib.Path(PEERS) / "bin" / "python"
if pathlib.Path(sys.prefix).resolve() != pathlib.Path(PEERS).resolve():
    os.execv(PYTHON, [str(PYTHON), *sys.argv])

# pylint: disable=wrong-import-position,import-error
import grpc  # noqa: E402
from google.protobuf import descriptor_pool, message_factory  # noqa: E402
from google.rpc import error_details_pb2  # noqa: E402
from grpc_health.v1 import health_pb2, health_pb2_grpc  # noqa: E402
from grpc_reflection.v1alpha.proto_reflection_descriptor_database import ProtoReflectionDescriptorDatabase  # noqa: E402
from grpc_status import rpc_status  # noqa: E402

GOLDEN = pathlib.Path(os.environ["BRDF_SOURCE_DIR"]) / "data" / "golden" / "rgb-lobes.brdfc"
DEADLINE = 30


class Api:
    """Calls of services that only reflection describes."""

    def __init__(self, channel):
        self.channel = channel
        self.database = ProtoReflectionDescriptorDatabase(channel)
        self.pool = descriptor_pool.DescriptorPool(self.database)

    def message(self, name, **fields):
        return message_factory.GetMessageClass(self.pool.FindMessageTypeByName(name))(**fields)

    def call(self, service, method, metadata=(), **fields):
        described = self.pool.FindServiceByName(service).FindMethodByName(method)
        request = message_factory.GetMessageClass(described.input_type)(**fields)
        answer = message_factory.GetMessageClass(described.output_type)
        unary = self.channel.unary_unary(f"/{service}/{method}", request_serializer=type(request).SerializeToString,
                                         response_deserializer=answer.FromString)
        return unary(request, timeout=DEADLINE, metadata=metadata)

    def brdf(self, method, **fields):
        return self.call("brdf.v1.BrdfService", method, **fields)


class OutsideClient(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="brdfd-outside-")
        root = pathlib.Path(cls.folder.name)
        (root / "materials").mkdir()
        shutil.copy(GOLDEN, root / "materials" / "gold.brdfc")
        cls.daemon = subprocess.Popen([BRDFD, "--repository", root / "materials", "--listen", f"unix:{root}/socket", "--reflection"],
                                      stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        assert b" ready: " in cls.daemon.stdout.readline()
        cls.channel = grpc.insecure_channel(f"unix:{root}/socket")
        cls.api = Api(cls.channel)

    @classmethod
    def tearDownClass(cls):
        cls.channel.close()
        cls.daemon.kill()
        cls.daemon.communicate()
        cls.folder.cleanup()

    def refused(self, code, method, **fields):
        with self.assertRaises(grpc.RpcError) as caught:
            self.api.brdf(method, **fields)
        self.assertEqual(caught.exception.code(), code)
        status = rpc_status.from_call(caught.exception)
        self.assertEqual(status.message, caught.exception.details())
        found = {}
        for any_detail in status.details:
            for kind in [error_details_pb2.ErrorInfo, error_details_pb2.BadRequest, error_details_pb2.RetryInfo]:
                detail = kind()
                if any_detail.Unpack(detail):
                    found[kind] = detail
        self.assertEqual(len(found), len(status.details))
        self.assertEqual(found[error_details_pb2.ErrorInfo].domain, "brdf.v1")
        return found

    def test_reflection_describes_the_services_and_health(self):
        names = set(self.api.database.get_services())
        self.assertLessEqual({"brdf.v1.BrdfService", "grpc.health.v1.Health"}, names)
        health = self.api.pool.FindServiceByName("grpc.health.v1.Health")
        self.assertEqual({m.name for m in health.methods}, {"Check", "Watch"})

    def test_health(self):
        answer = health_pb2_grpc.HealthStub(self.channel).Check(health_pb2.HealthCheckRequest(service="brdf.v1.BrdfService"), timeout=DEADLINE)
        self.assertEqual(answer.status, health_pb2.HealthCheckResponse.SERVING)

    def test_calls(self):
        page = self.api.brdf("ListMaterials")
        self.assertEqual([m.name for m in page.materials], ["materials/gold"])
        up = struct.pack("<3f", 0, 0, 1)
        answer = self.api.brdf("Evaluate", material="materials/gold", operations=3, count=1, wi=up, wo=up)
        self.assertEqual(answer.version, page.materials[0].version)
        self.assertTrue(all(v > 0 for v in struct.unpack("<3f", answer.values)))
        self.assertGreater(struct.unpack("<f", answer.pdf)[0], 0)

    def test_error_details(self):
        bad = self.refused(grpc.StatusCode.INVALID_ARGUMENT, "Evaluate", material="materials/gold", operations=1)
        self.assertEqual([v.field for v in bad[error_details_pb2.BadRequest].field_violations], ["count"])
        gone = self.refused(grpc.StatusCode.NOT_FOUND, "GetMaterial", name="materials/none")
        self.assertEqual(gone[error_details_pb2.ErrorInfo].reason, "MATERIAL_NOT_FOUND")
        self.assertNotIn(error_details_pb2.BadRequest, gone)


if __name__ == "__main__":
    unittest.main(verbosity=1)

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Replicas that are drained by turns, as grpcio sees it: round_robin and health, and no call is repeated. None may fail.

Needs grpcio (python3-grpcio of Debian, or $BRDF_RPC_PEERS, an environment with grpcio of PyPI); skipped without. --json prints a row of
brdf-load's table.
"""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

SKIPPED = 77
ROUNDS = int(os.environ.get("BRDF_DRAINS", "2"))
CALLERS = 3


def import_grpc():
    """grpcio of this interpreter, or this script again with one that has it."""
    try:
        import grpc
        return grpc
    except ImportError:
        peers = os.environ.get("BRDF_RPC_PEERS")
        for other in ([f"{peers}/bin/python"] if peers else []) + ["/usr/bin/python3"]:
            if not os.environ.get("BRDF_AGAIN") and os.access(other, os.X_OK):
                os.environ["BRDF_AGAIN"] = "1"
                os.execv(other, [other, *sys.argv])
        print("grpcio is not there")
        sys.exit(SKIPPED)


grpc = import_grpc()
SERVICE_CONFIG = {"loadBalancingConfig": [{"round_robin": {}}], "healthCheckConfig": {"serviceName": "brdf.v1.BrdfService"}}


def field(number, payload):
    """A field of bytes in protobuf's wire format; shorter than 128."""
    return bytes([number << 3 | 2, len(payload)]) + payload


class Replica:
    def __init__(self, folder, name):
        self.folder = folder
        self.name = name
        self.port = 0
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            [os.environ["BRDFD"], "--repository", self.folder, "--listen", f"127.0.0.1:{self.port}", "--log-level", "warning", "--compress-program", os.environ["BRDF_COMPRESS"]],
            stdout=subprocess.PIPE)
        line = self.process.stdout.readline().decode()
        assert " ready: " in line, line
        self.port = int(line.split("127.0.0.1:")[1].split()[0])

    def drain(self):
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(30) == 0, self.name


class Callers:
    """Call from several threads until they are stopped; count."""

    def __init__(self, ports):
        target = "ipv4:" + ",".join(f"127.0.0.1:{port}" for port in ports)
        self.channel = grpc.insecure_channel(target, options=[("grpc.enable_retries", 0), ("grpc.service_config", json.dumps(SERVICE_CONFIG))])
        self.get = self.channel.unary_unary("/brdf.v1.BrdfService/GetMaterial", request_serializer=None, response_deserializer=None)
        self.answered, self.failures, self.slowest = 0, [], 0.0
        self.lock, self.end = threading.Lock(), threading.Event()
        self.threads = [threading.Thread(target=self.call) for _ in range(CALLERS)]
        for thread in self.threads:
            thread.start()

    def call(self):
        request = field(1, b"materials/gold")
        while not self.end.is_set():
            start = time.monotonic()
            failure = None
            try:
                assert b"materials/gold/versions/" in self.get(request, timeout=10, wait_for_ready=False)
            except grpc.RpcError as error:
                failure = f"{error.code()}: {error.details()}"
            with self.lock:
                self.slowest = max(self.slowest, time.monotonic() - start)
                if failure:
                    self.failures.append(failure)
                else:
                    self.answered += 1

    def stop(self):
        self.end.set()
        for thread in self.threads:
            thread.join()
        self.channel.close()


def measure():
    with tempfile.TemporaryDirectory(prefix="brdfd-") as name, contextlib.ExitStack() as stack:
        folder = pathlib.Path(name)
        sample = folder / "sample.binary"
        subprocess.run([os.environ["BRDF_GONIO"], "sample", "-o", sample], check=True, stderr=subprocess.DEVNULL)
        (folder / "materials").mkdir()
        subprocess.run([os.environ["BRDF_COMPRESS"], "compress", sample, "-o", folder / "gold.brdfc", "--preset", "fastest", "-q"], check=True)
        shutil.copy(folder / "gold.brdfc", folder / "materials" / "gold.brdfc")
        replicas = [Replica(folder / "materials", f"replica {i}") for i in range(2)]
        for replica in replicas:
            stack.callback(lambda r=replica: (r.process.kill(), r.process.wait()))
        callers = Callers([replica.port for replica in replicas])
        stack.callback(callers.stop)
        time.sleep(0.7)
        for i in range(ROUNDS):
            replicas[i % 2].drain()
            time.sleep(0.3)
            replicas[i % 2].start()
            time.sleep(2.5)  # grpcio's own pause before it connects again is a second
        callers.stop()
        return callers


def main():
    callers = measure()
    for failure in callers.failures[:5]:
        print(failure, file=sys.stderr)
    total = callers.answered + len(callers.failures)
    sound = not callers.failures and callers.answered > 100
    row = {"name": "SIGTERM of one of two replicas: grpcio in Python, repeating nothing", "asked": "0 failed calls",
           "reached": f"{len(callers.failures)} failed of {total}, the slowest took {1000 * callers.slowest:.3g} ms",
           "ran": f"grpcio {grpc.__version__}, {CALLERS} threads, round_robin and health over loopback; {ROUNDS} ends, by turns", "met": sound, "sound": sound,
           "figures": {"failed": len(callers.failures), "answered": callers.answered, "slowest_seconds": callers.slowest}}
    print(json.dumps(row) if "--json" in sys.argv else row["reached"])
    return 0 if sound else 1


if __name__ == "__main__":
    for variable in ("BRDFD", "BRDF_COMPRESS", "BRDF_GONIO"):
        if variable not in os.environ:
            print(f"{variable} is not set")
            sys.exit(SKIPPED)
    sys.exit(main())

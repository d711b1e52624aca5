#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""server/deploy/haproxy.cfg in front of two replicas: TLS, health, drains and crashes. Skipped where haproxy or openssl is missing."""
import contextlib
import json
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from support.cli_harness import SKIPPED, compressed, program

BRDFD = program("brdfd")
BRDF_QUERY = program("brdf-query")
HAPROXY = shutil.which("haproxy") or shutil.which("haproxy", path="/usr/sbin")
OPENSSL = shutil.which("openssl")
EXAMPLE = pathlib.Path(os.environ.get("BRDF_SOURCE_DIR", ".")) / "server" / "deploy" / "haproxy.cfg"
PATIENCE = 60
DRAIN_DELAY = 5  # seconds; many checks, also of a busy machine


def free_port():
    """Below those that the system gives to whoever connects, one of which might take it in between."""
    while True:
        port = random.randrange(10000, 30000)
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def until(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.1)


class Replica:
    def __init__(self, folder):
        self.folder, self.port = folder, free_port()
        self.start()

    def start(self):
        self.process = subprocess.Popen([BRDFD, "--repository", self.folder, "--listen", f"127.0.0.1:{self.port}", "--drain-delay-seconds", str(DRAIN_DELAY),
                                         "--log-level", "warning"], stdout=subprocess.PIPE)
        assert b" ready: " in self.process.stdout.readline()

    def end(self, number):
        self.process.send_signal(number)
        code = self.process.wait(PATIENCE)
        self.process.stdout.close()
        return code


class Proxy(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="brdf-proxy-")
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        (self.folder / "materials").mkdir()
        shutil.copy(compressed(), self.folder / "materials" / "gold.brdfc")
        self.replicas = [Replica(self.folder / "materials") for _ in range(2)]
        self.addCleanup(lambda: [r.end(signal.SIGKILL) for r in self.replicas])
        subprocess.run([OPENSSL, "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", self.folder / "key.pem", "-out", self.folder / "ca.pem", "-days", "2",
                        "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"], check=True, capture_output=True)
        (self.folder / "brdf.pem").write_text((self.folder / "ca.pem").read_text() + (self.folder / "key.pem").read_text())
        self.port = free_port()
        text = EXAMPLE.read_text()
        for word, ours in ((":443 ", f"127.0.0.1:{self.port} "), ("/etc/haproxy/brdf.pem", str(self.folder / "brdf.pem")),
                           ("127.0.0.1:50051", f"127.0.0.1:{self.replicas[0].port}"), ("127.0.0.1:50052", f"127.0.0.1:{self.replicas[1].port}")):
            self.assertEqual(text.count(word), 1, word)
            text = text.replace(word, ours)
        (self.folder / "haproxy.cfg").write_text(text)
        checked = subprocess.run([HAPROXY, "-c", "-f", self.folder / "haproxy.cfg"], capture_output=True, text=True, check=False)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        with open(self.folder / "log", "wb") as log:
            self.proxy = subprocess.Popen([HAPROXY, "-f", self.folder / "haproxy.cfg"], stdout=log, stderr=log)
        self.addCleanup(self.proxy.wait)
        self.addCleanup(self.proxy.kill)

    def query(self, *arguments):
        return subprocess.run([BRDF_QUERY, "--server", f"localhost:{self.port}", "--ca", self.folder / "ca.pem", "--no-cache", *arguments],
                              input=b"0,0,1,0.6,0,0.8\n", capture_output=True, timeout=PATIENCE, check=False)

    def answers(self):
        return self.query("eval", "gold").returncode == 0

    def log(self):
        return (self.folder / "log").read_text()

    def test_replicas_come_and_go_and_no_call_fails(self):
        until(self.answers)
        health = self.query("health")
        self.assertEqual((health.stdout, health.stderr), (b"SERVING\n", b""))
        self.assertEqual([m["name"] for m in json.loads(self.query("list", "--json").stdout)["rows"]], ["materials/gold"])
        ended, failures, answered = threading.Event(), [], [0, 0]

        def call(caller):
            while not ended.is_set():
                done = self.query("eval", "gold")
                answered[caller] += 1
                if done.returncode != 0:
                    failures.append(done.stderr.decode())

        callers = [threading.Thread(target=call, args=(i,)) for i in range(2)]
        for c in callers:
            c.start()
        try:
            for name, replica in zip(("one", "two"), self.replicas):
                self.assertEqual(replica.end(signal.SIGTERM), 0)
                self.assertIn(f"brdfd/{name} is DOWN, reason: Layer7 invalid response", self.log())  # by its answer, and not when it was gone
                replica.start()
                until(lambda up=f"brdfd/{name} is UP": up in self.log())
        finally:
            ended.set()
            for c in callers:
                c.join()
        self.assertEqual(failures, [], self.log()[-4000:])
        self.assertGreater(min(answered), 10)

    def test_crashed_replicas_are_left_out_and_found_again(self):
        until(self.answers)
        self.replicas[0].end(signal.SIGKILL)
        until(lambda: "brdfd/one is DOWN" in self.log())
        self.assertTrue(self.answers())
        self.replicas[1].end(signal.SIGKILL)
        until(lambda: "has no server available" in self.log())
        self.assertFalse(self.answers())
        self.replicas[1].start()
        until(self.answers)
        self.replicas[0].start()


if __name__ == "__main__":
    if not HAPROXY or not OPENSSL:
        print("haproxy or openssl is not there")
        sys.exit(SKIPPED)
    unittest.main()

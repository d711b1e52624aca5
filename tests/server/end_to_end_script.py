#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brdfd on a unix socket and brdf-query: every verb, the same bytes as brdf-compress, compressions that end badly, the drain."""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from support.cli_harness import BRDF_COMPRESS, compressed, direction, main, measured, pack_floats, program

BRDFD = program("brdfd")
BRDF_QUERY = program("brdf-query")


@contextlib.contextmanager
def daemon(*flags, environment=None):
    """A daemon over a folder of its own: (process, address, folder). Killed at the end if it still runs."""
    with tempfile.TemporaryDirectory(prefix="brdfd-") as name:
        folder = pathlib.Path(name)
        (folder / "materials").mkdir()
        shutil.copy(compressed(), folder / "materials" / "gold.brdfc")
        address = f"unix:{folder}/socket"
        # A sanitizer reserves more addresses than any limit allows.
        if os.environ.get("BRDF_SANITIZE"):
            flags = ("--compress-memory-bytes", 0, *flags)
        process = subprocess.Popen(
            [BRDFD, "--repository", folder / "materials", "--listen", address, "--drain-delay-seconds", "0.2",
             "--poll-interval-seconds", "0.1", "--log-level", "warning", *map(str, flags)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, **(environment or {})})
        try:
            line = process.stdout.readline().decode()
            if " ready: " not in line:
                raise AssertionError(f"no ready line but {line!r}: {process.stderr.read().decode()}")
            yield process, address, folder
        finally:
            if process.poll() is None:
                process.kill()
            process.communicate()


def query(address, *arguments, stdin=b"", code=0, environment=None):
    done = subprocess.run([BRDF_QUERY, "--server", address, "--no-cache", *map(str, arguments)], input=stdin,
                          capture_output=True, timeout=120, check=False, env={**os.environ, **(environment or {})})
    assert done.returncode == code, (arguments, done.returncode, done.stderr.decode())
    return done


def compress(*arguments, stdin=b""):
    return subprocess.run([BRDF_COMPRESS, *map(str, arguments)], input=stdin, capture_output=True, timeout=120, check=True).stdout


def until(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.05)


def rows(count):
    values = []
    for i in range(count):
        values += direction((i * 37) % 95, i * 11 % 360) + direction((i * 53) % 91, i * 29 % 360)
    return values


class EndToEnd(unittest.TestCase):
    def test_rows_are_those_of_brdf_compress(self):
        binary = pack_floats(rows(20000))
        text = "".join(f"{v:.9g}" + (",\n"[i % 6 == 5]) for i, v in enumerate(rows(300))).encode()
        with daemon() as (_, address, folder):
            gold = folder / "materials" / "gold.brdfc"
            ends = [r["prefix_bytes"] for r in json.loads(query(address, "info", "gold", "--json").stdout)["rows"][0]["refinements"]]
            self.assertGreater(len(ends), 1)
            for extra in [[], ["--eval", "fast"], ["--eval", "exact"], ["--prefix", str(ends[0])]]:
                for local in [[], ["--local"]]:
                    for verb in ["eval", "pdf"]:
                        with self.subTest(verb=verb, extra=extra, local=local):
                            self.assertEqual(query(address, verb, "gold", "--format", "f32", *extra, *local, stdin=binary).stdout,
                                             compress(verb, gold, "--format", "f32", *extra, stdin=binary))
                            self.assertEqual(query(address, verb, "gold", *extra, *local, stdin=text).stdout,
                                             compress(verb, gold, *extra, stdin=text))
                    arguments = ["--wo=-0.6,0,0.8", "-n", "20000", "--seed", "7", "--format", "f32", *extra]
                    self.assertEqual(query(address, "sample", "gold", *arguments, *local).stdout, compress("sample", gold, *arguments))

    def test_rows_that_are_none(self):
        with daemon() as (_, address, _):
            self.assertIn("line 1", query(address, "eval", "gold", stdin=b"0,0,one,0,0,1\n", code=3).stderr.decode())
            self.assertEqual(query(address, "eval", "gold", stdin=b"0,0,0,0,0,1\n").stdout, b"0,0,0\n")
            self.assertEqual(query(address, "eval", "gold").stdout, b"")
            query(address, "eval", "silver", code=3)
            query(address, "eval", "../gold", code=2)
            query(address, "eval", "gold", "--prefix", "1", code=2)

    def test_list_info_fetch_similar_health(self):
        with daemon() as (_, address, folder):
            self.assertIn("gold", query(address, "list").stdout.decode())
            listed = json.loads(query(address, "list", "--json").stdout)
            self.assertEqual([m["name"] for m in listed["rows"]], ["materials/gold"])
            version = listed["rows"][0]["version"]
            query(address, "fetch", "gold", "-o", folder / "copy.brdfc")
            self.assertEqual((folder / "copy.brdfc").read_bytes(), compressed().read_bytes())
            query(address, "fetch", "gold", "-o", folder / "copy.brdfc", code=1)  # nothing is overwritten unasked
            query(address, "fetch", version, "-o", folder / "copy.brdfc", "-f")
            shutil.copy(compressed(), folder / "materials" / "twin.brdfc")
            until(lambda: b"twin" in query(address, "list").stdout)
            self.assertTrue(query(address, "similar", "gold").stdout.decode().startswith("0.00000  materials/twin/"))
            self.assertEqual(len(query(address, "similar", "--file", compressed()).stdout.splitlines()), 2)
            self.assertEqual(query(address, "health").stdout, b"SERVING\n")
            self.assertEqual(subprocess.run([BRDFD, "--health-check", address], capture_output=True, check=True).stdout, b"SERVING\n")

    def test_the_cache_serves_a_version_without_the_server(self):
        with daemon() as (process, address, folder):
            cached = [BRDF_QUERY, "--server", address, "--cache", folder / "cache", "--deadline", "10", "fetch"]
            subprocess.run([*cached, "gold", "-o", folder / "one.brdfc"], check=True, capture_output=True)
            version = json.loads(query(address, "info", "gold", "--json").stdout)["rows"][0]["version"]
            process.kill()
            process.wait()
            subprocess.run([*cached, version, "-o", folder / "two.brdfc"], check=True, capture_output=True)
            self.assertEqual((folder / "two.brdfc").read_bytes(), compressed().read_bytes())
            for file in (folder / "cache").iterdir():  # what does not hash to its name is not believed
                file.write_bytes(file.read_bytes()[:-1] + b"x")
            done = subprocess.run([*cached, version, "-o", folder / "three.brdfc"], check=False, capture_output=True)
            self.assertEqual(done.returncode, 1)

    def test_compress_publishes_what_brdf_compress_writes(self):
        with daemon() as (_, address, folder):
            query(address, "compress", measured(), "new", "--effort", "0", "--target-size", "600")
            compress("compress", measured(), "-o", folder / "here.brdfc", "--effort", "0", "--target-size", "600")
            self.assertEqual((folder / "materials" / "new.brdfc").read_bytes(), (folder / "here.brdfc").read_bytes())
            query(address, "compress", measured(), "new", "--effort", "0", code=1)  # it exists
            query(address, "compress", measured(), "impossible", "--effort", "0", "--target-size", "10", code=4)
            query(address, "compress", compressed(), "no-measurement", code=3)
            query(address, "compress", measured(), "../outside", code=2)
            self.assertEqual(sorted(p.name for p in (folder / "materials").iterdir()), ["gold.brdfc", "new.brdfc"])

    def test_limits_cost_one_compression_and_not_the_daemon(self):
        with tempfile.TemporaryDirectory(prefix="brdfd-upload-") as uploads:
            with daemon("--compress-seconds", "1", "--compress-folder", uploads) as (process, address, folder):
                done = query(address, "compress", measured(), "slow", "--effort", "100", code=3)
                self.assertIn("longer than", done.stderr.decode())
                self.assertEqual(os.listdir(uploads), [])
                self.assertIsNone(process.poll())
                self.assertEqual([p.name for p in (folder / "materials").iterdir()], ["gold.brdfc"])
            with daemon("--compress-upload-bytes", 1 << 20, "--compress-folder", uploads) as (_, address, _):
                self.assertIn("upload", query(address, "compress", measured(), "large", code=3).stderr.decode())
                self.assertEqual(os.listdir(uploads), [])

    def test_a_client_that_goes_away_ends_its_compression(self):
        with tempfile.TemporaryDirectory(prefix="brdfd-upload-") as uploads:
            with daemon("--compress-folder", uploads) as (_, address, folder):
                client = subprocess.Popen([BRDF_QUERY, "--server", address, "compress", measured(), "left", "--effort", "100"],
                                          stderr=subprocess.DEVNULL)
                until(lambda: any(pathlib.Path(uploads).rglob("upload")))
                time.sleep(0.5)
                client.kill()
                client.wait()
                until(lambda: os.listdir(uploads) == [])
                self.assertFalse((folder / "materials" / "left.brdfc").exists())

    def test_tokens(self):
        with tempfile.TemporaryDirectory() as name:
            tokens = pathlib.Path(name) / "tokens"
            tokens.write_text("read 0123456789abcdef\n")
            tokens.chmod(0o600)
            with daemon("--tokens", tokens, "--log-level", "debug") as (process, address, folder):
                query(address, "list", code=1)
                query(address, "list", code=1, environment={"BRDF_TOKEN": "not-the-right-token"})
                query(address, "list", environment={"BRDF_TOKEN": "0123456789abcdef"})
                query(address, "compress", measured(), "new", code=1, environment={"BRDF_TOKEN": "0123456789abcdef"})
                tokens.write_text("read fedcba9876543210\n")
                process.send_signal(signal.SIGHUP)
                until(lambda: subprocess.run([BRDF_QUERY, "--server", address, "list"], check=False, capture_output=True,
                                             env={**os.environ, "BRDF_TOKEN": "fedcba9876543210"}).returncode == 0)
                process.send_signal(signal.SIGTERM)
                logged = process.communicate(timeout=60)[1].decode()
                self.assertIn("call.refused", logged)
                for token in ["0123456789abcdef", "not-the-right-token", "fedcba9876543210"]:
                    self.assertNotIn(token, logged)

    def test_sigterm_drains(self):
        with daemon() as (process, address, _):
            process.send_signal(signal.SIGTERM)
            until(lambda: subprocess.run([BRDFD, "--health-check", address], capture_output=True, check=False).returncode == 1)
            self.assertEqual(process.wait(60), 0)

    def test_settings_that_are_refused(self):
        def refused(*flags, code=2):
            done = subprocess.run([BRDFD, *flags], capture_output=True, check=False, timeout=20)
            self.assertEqual(done.returncode, code, done.stderr.decode())
            return done.stderr.decode()

        self.assertIn("TLS", refused("--repository", "/tmp", "--listen", "0.0.0.0:0"))
        self.assertIn("repository", refused("--listen", "unix:/tmp/x"))
        self.assertIn("cannot open the repository", refused("--repository", "/nowhere/at/all", "--listen", "unix:/tmp/x", code=1))
        self.assertIn("--workers", refused("--repository", "/tmp", "--listen", "unix:/tmp/x", "--workers", "few"))
        with daemon() as (_, address, folder):
            self.assertIn("another process", refused("--repository", folder, "--listen", address, code=1))
        done = subprocess.run([BRDFD, "--repository", "/tmp", "--listen", "unix:/tmp/x", "--print-config"], capture_output=True,
                              check=True, env={**os.environ, "BRDFD_WORKERS": "3"})
        self.assertIn(b"workers = 3", done.stdout)
        subprocess.run([BRDFD, "--repository", "/tmp", "--listen", "unix:/tmp/x", "--check-config"], capture_output=True, check=True)

    def test_no_fitter_is_linked(self):
        libraries = subprocess.run(["ldd", BRDFD], capture_output=True, check=True).stdout
        self.assertIn(b"libgrpc", libraries)
        for fitter in [b"ceres", b"glog", b"cholmod"]:
            self.assertNotIn(fitter, libraries)

    def test_metrics(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        with daemon("--metrics-listen", f"127.0.0.1:{port}") as (_, address, _):
            query(address, "eval", "gold", stdin=b"0,0,1,0,0,1\n")
            with socket.create_connection(("127.0.0.1", port)) as http:
                http.sendall(b"GET /metrics HTTP/1.0\r\n\r\n")
                page = b"".join(iter(lambda: http.recv(65536), b""))
            self.assertIn(b'brdfd_queries_total{operation="evaluate"} 1', page)
            self.assertIn(b"brdfd_materials 1", page)


if __name__ == "__main__":
    main()

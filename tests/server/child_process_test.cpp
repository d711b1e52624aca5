// SPDX-License-Identifier: Apache-2.0
// The limits of a child process, on programs that break each of them.
#include "compress/child_process.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

#include <signal.h>

#include <chrono>

namespace {

using namespace brdf;
using namespace brdf::service;
using namespace std::chrono_literals;
using End = ChildResult::End;

ChildLimits minute() {
  ChildLimits l;
  l.time = 60s;
  return l;
}

ChildResult shell(const std::string& script, const ChildLimits& limits = minute(), const std::function<bool()>& stop = [] { return false; }) {
  return run_child({"/bin/sh", "-c", script}, limits, [](const std::string&) {}, stop);
}

TEST(ChildProcess, ExitCodeErrorsAndLines) {
  std::vector<std::string> lines;
  const ChildResult r = run_child({"/bin/sh", "-c", "echo one >&3; echo bad news >&2; echo two >&3; printf three >&3; echo lost; exit 7"}, minute(),
                                  [&](const std::string& line) { lines.push_back(line); }, [] { return false; });
  EXPECT_EQ(r.end, End::exited);
  EXPECT_EQ(r.code, 7);
  EXPECT_EQ(r.errors, "bad news\n");
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "two"})) << "a line without an end is none";
  EXPECT_EQ(shell("yes | head -c 100000 >&2").errors.size(), 4096U);
  EXPECT_EQ(run_child({"/no/such/program"}, minute(), [](const std::string&) {}, [] { return false; }).code, 127);
}

TEST(ChildProcess, OpensNothingOfItsParent) {
  const ChildResult r = shell("ls -l /proc/self/fd >&2; env >&2");
  EXPECT_EQ(r.errors.find("socket"), std::string::npos) << r.errors;
  EXPECT_EQ(r.errors.find("HOME="), std::string::npos) << r.errors;
  EXPECT_NE(r.errors.find("/dev/null"), std::string::npos) << r.errors;
}

TEST(ChildProcess, SignalsTimeAndStop) {
  const ChildResult aborted = shell("kill -ABRT $$");
  EXPECT_EQ(aborted.end, End::signalled);
  EXPECT_EQ(aborted.code, SIGABRT);
  ChildLimits short_time;
  short_time.time = 200ms;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(shell("sleep 1000 & sleep 1000", short_time).end, End::timed_out);
  int asked = 0;
  EXPECT_EQ(shell("trap '' TERM; sleep 1000", minute(), [&] { return ++asked == 5; }).end, End::stopped);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 30s);
}

TEST(ChildProcess, EndsWhereChildrenAreCollectedByThemselves) {
  const auto before = ::signal(SIGCHLD, SIG_IGN);
  const ChildResult r = shell("exit 0");
  ::signal(SIGCHLD, before);
  EXPECT_EQ(r.end, End::exited);
  EXPECT_EQ(r.code, 127) << "how it ended is not known, so it was no success";
}

TEST(ChildProcess, ExceptionsLeaveNoChild) {
  pid_t child = 0;
  const auto reads = [&](const std::string& line) {
    child = static_cast<pid_t>(std::stol(line));
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(run_child({"/bin/sh", "-c", "echo $$ >&3; sleep 1000"}, minute(), reads, [] { return false; }), std::runtime_error);
  ASSERT_GT(child, 0);
  EXPECT_EQ(::kill(child, 0), -1) << "it is gone, and collected";
}

TEST(ChildProcess, FloodsDoNotOutlastTheTime) {
  for (const char* flood : {"exec cat /dev/zero >&3", "exec cat /dev/zero >&2", "yes >&3 & yes >&2; true"}) {
    ChildLimits l;
    l.time = 300ms;
    const auto start = std::chrono::steady_clock::now();
    const ChildResult r = shell(flood, l);
    EXPECT_EQ(r.end, End::timed_out) << flood;
    EXPECT_LT(std::chrono::steady_clock::now() - start, 30s) << flood;
    EXPECT_LE(r.errors.size(), 4096U);
  }
}

TEST(ChildProcess, FileSizes) {
  test::TemporaryFolder folder;
  ChildLimits l = minute();
  l.file_bytes = 100'000;
  const ChildResult r = shell("head -c 1000000 /dev/zero > " + (folder / "large").string(), l);
  EXPECT_TRUE(r.end == End::signalled || r.code != 0);
  EXPECT_LE(std::filesystem::file_size(folder / "large"), 100'000U);
}

TEST(ChildProcess, Memory) {
  ChildLimits l = minute();
  // `tail` holds the line that has no end in memory.
  const std::string hungry = "head -c 200000000 /dev/zero | tail -n 1 | wc -c >&3";
  std::vector<std::string> lines;
  const auto keep = [&](const std::string& line) { lines.push_back(line); };
  run_child({"/bin/sh", "-c", hungry}, l, keep, [] { return false; });
  ASSERT_EQ(lines, (std::vector<std::string>{"200000000"}));
  lines.clear();
  l.memory_bytes = 100'000'000;
  run_child({"/bin/sh", "-c", hungry}, l, keep, [] { return false; });
  EXPECT_NE(lines, (std::vector<std::string>{"200000000"}));
}

}  // namespace

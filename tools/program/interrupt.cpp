// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <initializer_list>
#include <string_view>

namespace brdf::cli {
namespace {

volatile sig_atomic_t deferred = 0;
volatile sig_atomic_t pending = 0;

[[noreturn]] void leave(int number) noexcept {
  if (::isatty(STDERR_FILENO) != 0) {  // takes the progress bar away
    constexpr std::string_view erase_line = "\r\033[K";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, erase_line.data(), erase_line.size());
  }
  ::_exit(128 + number);
}

extern "C" void on_signal(int number) {
  if (deferred == 0) leave(number);
  pending = number;
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  ::sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // A shell starts background jobs with SIGINT ignored; that is left so.
    if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    ::sigaction(number, &action, nullptr);
  }
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);  // a file beyond the size that the user may write: the write itself then says so
}

DeferInterrupt::DeferInterrupt() noexcept { deferred = deferred + 1; }

bool DeferInterrupt::arrived() const noexcept { return pending != 0; }

DeferInterrupt::~DeferInterrupt() {
  deferred = deferred - 1;
  if (deferred == 0 && pending != 0) leave(pending);
}

}  // namespace brdf::cli

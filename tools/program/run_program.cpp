// SPDX-License-Identifier: Apache-2.0
#include "run_program.h"

#include "interrupt.h"
#include "messages.h"

#include <exception>
#include <new>

namespace brdf::cli {

int run_program(const std::string& name, const std::function<ExitCode()>& body) {
  set_program_name(name);
  install_signal_handlers();
  ExitCode code = ExitCode::failed;
  try {
    code = body();
  } catch (const Failure& e) {
    complain(e.what());
    code = e.code();
  } catch (const Error& e) {
    complain(e.what());
    code = exit_code_of(e.code());
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& e) {
    complain(e.what());
  }
  return static_cast<int>(code);
}

}  // namespace brdf::cli

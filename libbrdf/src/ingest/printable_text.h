// SPDX-License-Identifier: Apache-2.0
// Text from files that nobody trusts, made safe for messages, terminals and JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace brdf::ingest {

/// At most `longest` bytes of `text` as valid UTF-8: control characters become spaces, bytes that are no UTF-8 question
/// marks; spaces at the end are dropped.
std::string printable_text(std::string_view text, std::size_t longest = 4096);

/// A name as it may appear in a message: printable ASCII, short, in single quotes.
std::string in_quotes(std::string_view text);

}  // namespace brdf::ingest

#pragma once

#include <string>
#include <string_view>

namespace myotact {

/// One field of a CSV line as RFC 4180 wants it, quoted where it has to be. What people wrote must not become a formula
/// of the spreadsheet that opens it: before "=", "+", "-" and "@" an apostrophe is put.
std::string csv_field(std::string_view text);

}  // namespace myotact

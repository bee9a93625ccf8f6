#pragma once

#include <string>
#include <vector>

namespace myotact {

/// Longest list: a table of more rows than anybody reads, and no typing slip exhausts the memory.
inline constexpr std::size_t kLongestNumberList = 10'000;

/// The numbers of a command-line option: "0,0.25,1", or "first:step:last" with both ends, or several of both with
/// commas between. Decimals stay exact: 0:0.1:1 holds the double nearest to 0.3. Throws Error Usage that names
/// `option`, the text and what is wrong with it: no number, no rising step, a last value that the steps miss.
std::vector<double> parse_number_list(const std::string& option, const std::string& text);

}  // namespace myotact

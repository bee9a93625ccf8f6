#include "exchange/febio_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/file.h"
#include "core/text.h"

namespace myotact::exchange {

namespace {

constexpr std::size_t kLargestFebio_bytes = std::size_t{256} << 20;  // a million quadratic tets
constexpr std::size_t kListed = 12;                                  // elements that an error names

std::string febio_bytes(const std::filesystem::path& path) {
  std::error_code ignored;  // what is wrong is said by who reads it
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > kLargestFebio_bytes) {
    throw bad_data(path.string(), "",
                   fmt::format("has {} MB; at most {} are read", size >> 20, kLargestFebio_bytes >> 20));
  }
  return read_file(path);
}

/// Commas and blanks part numbers.
std::vector<std::string_view> listed_words(std::string_view text) {
  std::vector<std::string_view> words;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t from = text.find_first_not_of(", \t\r\n", begin);
    if (from == std::string_view::npos) break;
    const std::size_t to = std::min(text.find_first_of(", \t\r\n", from), text.size());
    words.push_back(text.substr(from, to - from));
    begin = to;
  }
  return words;
}

}  // namespace

FebioFile::FebioFile(const std::filesystem::path& path) : FebioFile(febio_bytes(path), path.string()) {}

FebioFile::FebioFile(std::string text, std::string name) : name_(std::move(name)), text_(std::move(text)) {
  lines_.push_back(0);
  for (std::size_t k = 0; k < text_.size(); ++k) {
    if (text_[k] == '\n') lines_.push_back(k + 1);
  }
  parse();
}

void FebioFile::parse() {
  // Entities of a DOCTYPE are never expanded: the parser knows the five of XML alone.
  const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size());
  if (!result) {
    const auto line =
        std::upper_bound(lines_.begin(), lines_.end(), static_cast<std::size_t>(result.offset)) - lines_.begin();
    throw bad_data(name_, fmt::format("line {}", line),
                   fmt::format("is no XML that ends as it should ({}); write the file again", result.description()));
  }
  const pugi::xml_node febio = root();
  if (std::string(febio.name()) != "febio_spec") {
    throw error(febio, "must be <febio_spec>: this is no FEBio model");
  }
  const std::string version = febio.attribute("version").value();
  if (version != "4.0") {
    throw error(febio, fmt::format("has the version \"{}\"; must be 4.0. Open it in FEBio Studio and export it as 4.0",
                                   version));
  }
  const pugi::xml_node module = febio.child("Module");
  const std::string type = module.attribute("type").value();
  if (type != "solid") {
    throw error(module ? module : febio, fmt::format("has the module \"{}\"; must be \"solid\"", type));
  }
}

std::size_t FebioFile::line_of(const pugi::xml_node& node) const {
  const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, node.offset_debug()));
  return static_cast<std::size_t>(std::upper_bound(lines_.begin(), lines_.end(), offset) - lines_.begin());
}

std::string FebioFile::place_of(const pugi::xml_node& node) const {
  std::string name = node.name();
  constexpr std::size_t kLongestName = 60;
  if (name.size() > kLongestName) name = name.substr(0, kLongestName) + "...";
  return fmt::format("line {}: <{}>", line_of(node), name);
}

Error FebioFile::error(const pugi::xml_node& node, const std::string& problem) const {
  return bad_data(name_, place_of(node), problem);
}

std::string FebioFile::attribute(const pugi::xml_node& node, const char* attribute) const {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) throw error(node, fmt::format("has no attribute \"{}\"; add it", attribute));
  return found.value();
}

pugi::xml_node FebioFile::child(const pugi::xml_node& node, const char* name) const {
  const pugi::xml_node found = node.child(name);
  if (!found) throw error(node, fmt::format("has no <{}>; add it", name));
  return found;
}

std::vector<double> FebioFile::numbers(const pugi::xml_node& node, std::size_t count) const {
  const auto words = listed_words(node.child_value());
  if (count != 0 && words.size() != count) {
    throw error(node, fmt::format("holds {} numbers; must hold {}", words.size(), count));
  }
  std::vector<double> out;
  out.reserve(words.size());
  for (const std::string_view word : words) {
    const auto number = parse_number(word);
    if (!number || !std::isfinite(*number)) {
      throw error(node, fmt::format("holds \"{}\", which is no finite number", std::string(word.substr(0, 40))));
    }
    out.push_back(*number);
  }
  return out;
}

Vec3 FebioFile::vector(const pugi::xml_node& node) const {
  const std::vector<double> v = numbers(node, 3);
  return {v[0], v[1], v[2]};
}

std::vector<int> FebioFile::ids(const pugi::xml_node& node) const {
  std::vector<int> out;
  for (const double number : numbers(node, 0)) {
    if (!(number >= 1.0 && number <= std::numeric_limits<int>::max() && number == std::floor(number))) {
      throw error(node, fmt::format("holds {}; must be a whole number from 1 on", to_text(number)));
    }
    out.push_back(static_cast<int>(number));
  }
  return out;
}

double FebioFile::value(const pugi::xml_node& node, const char* name) const {
  const pugi::xml_node found = child(node, name);
  return number(found) * scale_of(found);
}

double FebioFile::value(const pugi::xml_node& node, const char* name, double fallback) const {
  return node.child(name) ? value(node, name) : fallback;
}

bool FebioFile::has_curve(const pugi::xml_node& node) const {
  return static_cast<bool>(node.attribute("lc"));
}

const FebioFile::Curve& FebioFile::curve_of(const pugi::xml_node& node) const {
  const std::string id = node.attribute("lc").value();
  const auto found = curves_.find(id);
  if (found == curves_.end()) {
    throw error(node, fmt::format("follows the load controller \"{}\", which <LoadData> does not have", id));
  }
  return found->second;
}

double FebioFile::scale_of(const pugi::xml_node& node) const {
  return has_curve(node) ? at_end(curve_of(node), node) : 1.0;
}

double FebioFile::rise_s(const pugi::xml_node& node) const {
  if (!has_curve(node)) return 0.0;
  const auto& points = curve_of(node).points;
  const auto is = [&](std::size_t k, double value) { return points[k].second == value; };
  if (std::all_of(points.begin(), points.end(), [](const auto& point) { return point.second == 1.0; })) return 0.0;
  if (points.size() == 2 && points[0].first == 0.0 && is(0, 0.0) && is(1, 1.0)) return points[1].first;
  throw error(node, "follows a curve that neither is 1 nor rises from (0, 0) to 1; in motion others are not read");
}

double FebioFile::at_end(const Curve& curve, const pugi::xml_node& node) const {
  const auto& points = curve.points;
  const auto after = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.first >= end_s_; });
  if (after == points.end()) {
    if (!curve.extrapolates || points.size() < 2) return points.back().second;
    const auto& [t0, v0] = points[points.size() - 2];
    const auto& [t1, v1] = points.back();
    return v1 + (end_s_ - t1) * (v1 - v0) / (t1 - t0);
  }
  if (after->first == end_s_ || after == points.begin()) return after->second;
  const auto before = std::prev(after);
  if (curve.stepped) return after->second;
  if (curve.linear) {
    return before->second +
           (end_s_ - before->first) * (after->second - before->second) / (after->first - before->first);
  }
  throw error(node, fmt::format("follows a smooth curve that has no point at the end, {} s; add one", to_text(end_s_)));
}

FebioFile::Curve FebioFile::read_curve(const pugi::xml_node& node) const {
  Curve curve;
  const std::string kind = lower(node.child_value("interpolate"));
  curve.linear = kind.empty() || kind == "linear";
  curve.stepped = kind == "step";
  curve.extrapolates = lower(node.child_value("extend")) == "extrapolate";
  for (const pugi::xml_node& point : child(node, "points").children("pt")) {
    const std::vector<double> pair = numbers(point, 2);
    if (!curve.points.empty() && pair[0] <= curve.points.back().first) {
      throw error(point, fmt::format("has the time {}, not after the one before; times must rise", to_text(pair[0])));
    }
    curve.points.emplace_back(pair[0], pair[1]);
  }
  if (curve.points.empty()) throw error(node, "has no point; add at least one");
  return curve;
}

void FebioFile::read_curves(double end_s) {
  end_s_ = end_s;
  for (const pugi::xml_node& node : root().child("LoadData").children()) {
    if (node.type() != pugi::node_element) continue;
    if (std::string(node.attribute("type").value()) != "loadcurve") {
      cannot(node, fmt::format("of the type \"{}\": only \"loadcurve\" is read", node.attribute("type").value()));
      continue;
    }
    curves_[attribute(node, "id")] = read_curve(node);
  }
}

void FebioFile::refuse_all() const {
  if (refused_.empty()) return;
  std::vector<std::string> shown(refused_.begin(),
                                 refused_.begin() + static_cast<std::ptrdiff_t>(std::min(refused_.size(), kListed)));
  if (shown.size() < refused_.size()) shown.push_back(fmt::format("and {} more", refused_.size() - shown.size()));
  throw bad_data(name_, "",
                 "holds what would change the answer and is not read: " + join(shown, "; ") +
                     ". Take these out of the model, or replace them");
}

}  // namespace myotact::exchange

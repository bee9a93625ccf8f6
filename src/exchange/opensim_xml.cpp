#include "exchange/opensim_xml.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/text.h"
#include "net/wire.h"

namespace myotact::exchange::opensim {
namespace {

constexpr int kDeepest = 64;               // models nest some 15 elements
constexpr std::size_t kMostKinds = 2000;   // entries of the list of what was not taken
constexpr std::size_t kMostObjects = 200;  // names in one entry of it
constexpr double kFirstVersion = 40000.0;  // of OpenSim 4.0
constexpr double kVersionAfter = 50000.0;

bool is_element(const pugi::xml_node& node) {
  return node.type() == pugi::node_element;
}

/// Nothing in it but blanks: "<groups />".
bool is_empty(const pugi::xml_node& node) {
  for (const pugi::xml_node& child : node.children()) {
    if (is_element(child)) return false;
    const std::string_view text = child.value();
    if ((child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) &&
        text.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      return false;
    }
  }
  return true;
}

/// Its own name, or that of what it belongs to.
std::string object_of(pugi::xml_node node) {
  for (; node; node = node.parent()) {
    if (const std::string name = node.attribute("name").value(); !name.empty()) return name;
  }
  return "";
}

std::string shortened(std::string text) {
  constexpr std::size_t kMost = 60;
  if (text.size() <= kMost) return text;
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a character
  return text.substr(0, end) + "...";
}

/// The next node in the order of the file that is not below `node`; none outside of `top`.
pugi::xml_node next_beside(pugi::xml_node node, const pugi::xml_node& top) {
  while (node && node != top) {
    if (const pugi::xml_node beside = node.next_sibling()) return beside;
    node = node.parent();
  }
  return {};
}

bool too_deep(const pugi::xml_node& top) {
  int depth = 0;
  for (pugi::xml_node node = top.first_child(); node;) {
    if (depth > kDeepest) return true;
    if (const pugi::xml_node below = node.first_child()) {
      node = below;
      ++depth;
      continue;
    }
    while (node && node != top && !node.next_sibling()) {
      node = node.parent();
      --depth;
    }
    if (!node || node == top) return false;
    node = node.next_sibling();
  }
  return false;
}

}  // namespace

Document::Document(std::string_view text, std::string file) : file_(std::move(file)) {
  if (text.size() > kLargestModel_bytes) {
    throw bad_data(file_, "", fmt::format("has {} bytes; a model has at most {}", text.size(), kLargestModel_bytes));
  }
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts_.push_back(static_cast<std::ptrdiff_t>(i) + 1);
  }
  // The parser takes any bytes; a specimen's JSON does not.
  if (!net::is_utf8({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()})) {
    throw bad_data(file_, "", "is no UTF-8, in which OpenSim writes; save the model again with OpenSim 4");
  }
  // Entities of a document type are never expanded by the parser; with one, the text would not be what it stands for.
  const auto parsed =
      xml_.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!parsed) {
    const auto line = std::upper_bound(line_starts_.begin(), line_starts_.end(), parsed.offset) - line_starts_.begin();
    throw bad_data(file_, fmt::format("line {}", line),
                   fmt::format("is no XML of UTF-8 from there on ({}); save the model again with OpenSim 4",
                               lower(parsed.description())));
  }
  for (const pugi::xml_node& node : xml_.children()) {
    if (node.type() != pugi::node_doctype) continue;
    throw bad_data(file_, "", "has a DOCTYPE, which OpenSim never writes and nothing here expands; remove it");
  }
  if (too_deep(xml_)) {
    throw bad_data(file_, "", fmt::format("nests its elements more than {} deep, which no model does", kDeepest));
  }
  check_version();
}

void Document::check_version() const {
  const pugi::xml_node root = xml_.child("OpenSimDocument");
  if (!root) {
    throw bad_data(file_, "",
                   fmt::format("begins with <{}>; a model of OpenSim begins with <OpenSimDocument>",
                               shortened(xml_.document_element().name())));
  }
  const std::string text = root.attribute("Version").value();
  const auto version = parse_number(text);
  if (!version || !(*version >= kFirstVersion && *version < kVersionAfter)) {
    throw bad_data(file_, place(root),
                   fmt::format("Version is \"{}\"; must be 40000 to 49999, the format of OpenSim 4: open the model "
                               "with OpenSim 4 and save it",
                               shortened(text)));
  }
  if (!root.child("Model")) {
    throw bad_data(file_, place(root),
                   "holds no <Model>; setups of tools and data are not read, name the model itself");
  }
}

Element Document::model() {
  const pugi::xml_node node = xml_.child("OpenSimDocument").child("Model");
  mark(node);
  return {*this, node};
}

std::string Document::place(const pugi::xml_node& node) const {
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), node.offset_debug());
  return fmt::format("line {}", after - line_starts_.begin());
}

std::vector<NotTaken> Document::not_taken() const {
  std::vector<NotTaken> list;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  const auto add = [&](const pugi::xml_node& node, const std::string& reason) {
    const auto key = std::pair{shortened(node.name()), reason};
    const auto found = known.find(key);
    if (found == known.end() && list.size() >= kMostKinds) return;
    const std::size_t entry = found == known.end() ? known.emplace(key, list.size()).first->second : found->second;
    if (entry == list.size()) list.push_back({key.first, {}, place(node), reason, 0});
    NotTaken& kind = list[entry];
    ++kind.count;
    const std::string object = shortened(object_of(node));
    const bool again = !kind.objects.empty() && kind.objects.back() == object;
    if (!again && kind.objects.size() < kMostObjects) kind.objects.push_back(object);
  };
  const pugi::xml_node top = xml_.child("OpenSimDocument");
  for (pugi::xml_node node = top.first_child(); node;) {
    const auto reason = reasons_.find(node.internal_object());
    const bool taken = taken_.contains(node.internal_object());
    if (is_element(node) && reason != reasons_.end()) add(node, reason->second);
    if (is_element(node) && reason == reasons_.end() && !taken && !is_empty(node)) add(node, "");
    const pugi::xml_node below = taken ? node.first_child() : pugi::xml_node{};
    node = below ? below : next_beside(node, top);
  }
  return list;
}

std::string Element::text() const {
  std::string text = node_.child_value();
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto words = words_of(text);
  if (words.empty()) return "";
  return {words.front().data(),
          static_cast<std::size_t>(words.back().data() + words.back().size() - words.front().data())};
}

std::optional<Element> Element::find(const char* tag) const {
  const pugi::xml_node child = node_.child(tag);
  if (!child) return std::nullopt;
  document_->mark(child);
  return Element(*document_, child);
}

std::optional<Element> Element::find_named(const char* name) const {
  const pugi::xml_node child = node_.find_child_by_attribute("name", name);
  if (!child) return std::nullopt;
  document_->mark(child);
  return Element(*document_, child);
}

Element Element::at(const char* tag) const {
  if (const auto child = find(tag)) return *child;
  throw error(fmt::format("has no <{}>; save the model again with OpenSim 4", tag));
}

std::vector<Element> Element::children() const {
  std::vector<Element> all;
  for (const pugi::xml_node& child : node_.children()) {
    if (is_element(child)) all.emplace_back(*document_, child);
  }
  return all;
}

std::vector<Element> Element::objects(const char* tag) const {
  const auto set = find(tag);
  if (!set) return {};
  const auto objects = set->find("objects");
  return objects ? objects->children() : std::vector<Element>{};
}

std::vector<double> Element::numbers() const {
  std::vector<double> values;
  const std::string whole = text();
  for (const std::string_view word : words_of(whole)) {
    const auto value = parse_number(word);
    if (!value || !std::isfinite(*value)) {
      throw error(fmt::format("holds \"{}\"; must be a finite number", shortened(std::string(word))));
    }
    values.push_back(*value);
  }
  return values;
}

double Element::number(const char* tag) const {
  const Element child = at(tag);
  const std::vector<double> values = child.numbers();
  if (values.size() != 1) throw child.error(fmt::format("holds {} numbers; must be one", values.size()));
  return values[0];
}

double Element::number_or(const char* tag, double otherwise) const {
  const auto child = find(tag);
  return child && !child->text().empty() ? number(tag) : otherwise;
}

Vec3 Element::vec3_or(const char* tag, const Vec3& otherwise) const {
  const auto child = find(tag);
  if (!child) return otherwise;
  const std::vector<double> values = child->numbers();
  if (values.size() != 3) throw child->error(fmt::format("holds {} numbers; must be three", values.size()));
  return {values[0], values[1], values[2]};
}

std::string Element::text_or(const char* tag, const std::string& otherwise) const {
  const auto child = find(tag);
  return child ? child->text() : otherwise;
}

bool Element::flag_or(const char* tag, bool otherwise) const {
  const auto child = find(tag);
  if (!child || child->text().empty()) return otherwise;
  const std::string word = lower(child->text());
  if (word == "true" || word == "1") return true;
  if (word == "false" || word == "0") return false;
  throw child->error(fmt::format("is \"{}\"; must be true or false", shortened(word)));
}

void Element::leave(const std::string& reason) const {
  document_->give_reason(node_, reason);
  document_->unmark(node_);
}

Error Element::error(const std::string& problem) const {
  const std::string object = shortened(object_of(node_));
  return bad_data(document_->file(), place(),
                  fmt::format("{}{}: {}", shortened(tag()), object.empty() ? "" : " of " + object, problem));
}

}  // namespace myotact::exchange::opensim

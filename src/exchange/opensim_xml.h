#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <pugixml.hpp>

#include "core/error.h"
#include "core/pose.h"
#include "exchange/opensim.h"

namespace myotact::exchange::opensim {

class Element;

/// The tree of an .osim file that remembers what of it was read, so that the rest can be told.
class Document {
 public:
  /// Throws Error BadData: too large, no XML, too deep, with a DOCTYPE, no OpenSimDocument of version 4, no Model.
  Document(std::string_view text, std::string file);

  Element model();
  const std::string& file() const { return file_; }
  std::string place(const pugi::xml_node& node) const;  // "line 12"

  void mark(const pugi::xml_node& node) { taken_.insert(node.internal_object()); }
  void unmark(const pugi::xml_node& node) { taken_.erase(node.internal_object()); }
  void give_reason(const pugi::xml_node& node, const std::string& reason) { reasons_[node.internal_object()] = reason; }
  /// What was never marked, apart from what is empty: with all that it holds one entry, by kind and reason.
  std::vector<NotTaken> not_taken() const;

 private:
  void check_version() const;

  std::string file_;
  pugi::xml_document xml_;
  std::vector<std::ptrdiff_t> line_starts_;
  std::unordered_set<const void*> taken_;
  std::unordered_map<const void*, std::string> reasons_;
};

/// One element. Reading of it marks what was read. The document outlives it.
class Element {
 public:
  Element(Document& document, pugi::xml_node node) : document_(&document), node_(node) {}

  std::string tag() const { return node_.name(); }
  /// Its attribute `name`.
  std::string name() const { return node_.attribute("name").value(); }
  std::string place() const { return document_->place(node_); }
  /// The text in it, without blanks at its ends.
  std::string text() const;

  std::optional<Element> find(const char* tag) const;
  /// The same by the value of its attribute `name`, whatever the tag.
  std::optional<Element> find_named(const char* name) const;
  /// Throws Error BadData where it is missing.
  Element at(const char* tag) const;
  /// The elements in it, none of which is marked.
  std::vector<Element> children() const;
  /// Those in TAG/objects; none where there is no such set. Set and objects are marked, its members are not.
  std::vector<Element> objects(const char* tag) const;

  double number(const char* tag) const;
  double number_or(const char* tag, double otherwise) const;
  Vec3 vec3_or(const char* tag, const Vec3& otherwise) const;
  /// Finite numbers in the element's own text.
  std::vector<double> numbers() const;
  std::string text_or(const char* tag, const std::string& otherwise) const;
  bool flag_or(const char* tag, bool otherwise) const;

  void take() const { document_->mark(node_); }
  /// Its mark is taken back, and the list says why.
  void leave(const std::string& reason) const;
  /// It is read and still listed, because it was taken otherwise than it stands there.
  void tell(const std::string& reason) const { document_->give_reason(node_, reason); }
  /// "FILE: line 12: TAG NAME: PROBLEM".
  Error error(const std::string& problem) const;

 private:
  Document* document_;
  pugi::xml_node node_;
};

}  // namespace myotact::exchange::opensim

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "core/error.h"
#include "core/vector.h"

// A .feb file as XML: every error names its line. For the readers of this folder alone.

namespace myotact::exchange {

/// The document with what its elements are asked for. Names of elements are looked at one by one, so that what is not
/// read is known: note_left_out() for what changes no answer, refuse_all() for what does.
class FebioFile {
 public:
  /// Throws Error NoInput, BadData: not XML, larger than 256 MB, no FEBio 4.0.
  explicit FebioFile(const std::filesystem::path& path);
  /// The same from text; `name` is for messages.
  FebioFile(std::string text, std::string name);

  pugi::xml_node root() const { return document_.document_element(); }
  const std::string& name() const { return name_; }

  /// FILE: line N: <element>: problem.
  Error error(const pugi::xml_node& node, const std::string& problem) const;

  /// Throws when it has none.
  std::string attribute(const pugi::xml_node& node, const char* attribute) const;
  pugi::xml_node child(const pugi::xml_node& node, const char* name) const;
  /// The text of an element: finite numbers between commas or blanks. `count` 0: any number of them.
  std::vector<double> numbers(const pugi::xml_node& node, std::size_t count) const;
  double number(const pugi::xml_node& node) const { return numbers(node, 1)[0]; }
  Vec3 vector(const pugi::xml_node& node) const;
  /// Whole numbers likewise, at least 1.
  std::vector<int> ids(const pugi::xml_node& node) const;
  /// The child's number times its load curve at the end; `fallback` where there is no such child.
  double value(const pugi::xml_node& node, const char* name, double fallback) const;
  /// The same of a child that must be there.
  double value(const pugi::xml_node& node, const char* name) const;

  /// What load curve `lc` of an element (1 without one) has at the end of the analysis.
  double scale_of(const pugi::xml_node& node) const;
  bool has_curve(const pugi::xml_node& node) const;
  /// When a curve from (0, 0) has reached 1; 0 for one that is 1 throughout. Throws for others.
  double rise_s(const pugi::xml_node& node) const;
  /// To be called before scale_of(): the curves of <LoadData>, to be taken at `end_s`.
  void read_curves(double end_s);

  void note_left_out(const pugi::xml_node& node) { left_out_.push_back(place_of(node)); }
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// An element that would change the answer and is not read; `what` names it.
  void cannot(const pugi::xml_node& node, const std::string& what) { refused_.push_back(place_of(node) + " " + what); }
  /// Throws Error BadData listing all of them, when there are any.
  void refuse_all() const;

 private:
  void parse();
  std::size_t line_of(const pugi::xml_node& node) const;
  std::string place_of(const pugi::xml_node& node) const;
  struct Curve {
    bool linear = true;  // else it keeps its value up to the next point, or is smooth: known at points only
    bool stepped = false;
    bool extrapolates = false;
    std::vector<std::pair<double, double>> points;
  };
  Curve read_curve(const pugi::xml_node& node) const;
  double at_end(const Curve& curve, const pugi::xml_node& node) const;
  const Curve& curve_of(const pugi::xml_node& node) const;

  std::string name_, text_;
  pugi::xml_document document_;
  std::vector<std::size_t> lines_;  // where each begins
  std::map<std::string, Curve> curves_;
  double end_s_ = 1.0;
  std::vector<std::string> left_out_, refused_;
};

}  // namespace myotact::exchange

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "prepare/guess/markups.h"
#include "prepare/guess/part_names.h"

namespace myotact::prepare {

namespace {

/// Points nearer to each other are one [m].
constexpr double kSamePoint_m = 1e-5;

/// Slicer numbers the points of a node: "origin biceps-2".
std::string without_number(const std::string& label) {
  const std::size_t dash = label.rfind('-');
  if (dash == std::string::npos || dash + 1 == label.size()) return label;
  const bool digits = std::all_of(label.begin() + static_cast<std::ptrdiff_t>(dash) + 1, label.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
  return digits ? label.substr(0, dash) : label;
}

/// What follows the word, as a key, when the name begins with it.
std::optional<std::string> after(const std::string& word, const std::string& name) {
  const std::string key = part_key(name);
  if (!key.starts_with(word + "_")) return {};
  return key.substr(word.size() + 1);
}

class Reader {
 public:
  Reader(const std::vector<std::string>& bones, const std::vector<std::string>& muscles) {
    for (const std::string& key : bones) bones_.push_back(part_key(key));
    for (const std::string& key : muscles) muscles_.push_back(part_key(key));
  }

  void read(const Markup& markup) {
    if (markup.kind == MarkupKind::Points) {
      for (const MarkupPoint& point : markup.points) read_point(markup, point);
      return;
    }
    for (const std::string& name : names_of(markup)) {
      if (const auto rest = after("joint", name)) return add_joint(markup, *rest);
      if (const auto rest = after("line", name)) return add_line(markup, *rest);
    }
    throw refused(markup, markup.name, "must begin with \"joint\" or \"line\"");
  }

  LimbMarks marks;

 private:
  /// The first label, with and without its number, then the file.
  static std::vector<std::string> names_of(const Markup& markup) {
    std::vector<std::string> names;
    if (!markup.points.empty()) {
      names.push_back(without_number(markup.points.front().label));
      names.push_back(markup.points.front().label);
    }
    names.push_back(markup.name);
    return names;
  }

  static Error refused(const Markup& markup, const std::string& name, const std::string& problem) {
    return bad_data(markup.file, fmt::format("markup \"{}\"", name),
                    problem +
                        "; names are \"origin MUSCLE\", \"insertion MUSCLE\", \"line MUSCLE\" and "
                        "\"joint NAME PARENT_BONE CHILD_BONE\"");
  }

  int muscle_named(const Markup& markup, const std::string& key) const {
    const auto found = std::find(muscles_.begin(), muscles_.end(), key);
    if (found != muscles_.end()) return static_cast<int>(found - muscles_.begin());
    throw refused(markup, key,
                  fmt::format("names the muscle \"{}\" that is not there; the nearest is \"{}\"", key,
                              nearest_word(key, muscles_)));
  }

  void read_point(const Markup& markup, const MarkupPoint& point) {
    for (const std::string& name : {without_number(point.label), point.label, markup.name}) {
      for (const bool origin : {true, false}) {
        const auto rest = after(origin ? "origin" : "insertion", name);
        if (!rest) continue;
        (origin ? marks.origins : marks.insertions).push_back({muscle_named(markup, *rest), {point.position_m}});
        return;
      }
    }
    throw refused(markup, point.label, "must begin with \"origin\" or \"insertion\"");
  }

  void add_line(const Markup& markup, const std::string& key) {
    MarkedMuscle line{muscle_named(markup, key), {}};
    for (const MarkupPoint& point : markup.points) {
      const bool again = !line.points_m.empty() && (line.points_m.back() - point.position_m).norm() < kSamePoint_m;
      if (!again) line.points_m.push_back(point.position_m);
    }
    if (line.points_m.size() < 2) {
      throw refused(markup, key, fmt::format("has {} points; a line needs two or more", line.points_m.size()));
    }
    marks.lines.push_back(std::move(line));
  }

  void add_joint(const Markup& markup, const std::string& words) {
    if (markup.points.size() != 2) {
      throw refused(markup, words, fmt::format("has {} points; an axis needs two", markup.points.size()));
    }
    MarkedJoint joint{words, -1, -1, {markup.points[0].position_m, markup.points[1].position_m}};
    if ((joint.axis_m[1] - joint.axis_m[0]).norm() < kSamePoint_m) {
      throw refused(markup, words, "has both points in one place; an axis needs two");
    }
    for (int p = 0; p < static_cast<int>(bones_.size()); ++p) {
      for (int c = 0; c < static_cast<int>(bones_.size()); ++c) {
        const std::string ending = "_" + bones_[at(p)] + "_" + bones_[at(c)];
        if (p == c || !words.ends_with(ending)) continue;
        const std::string key = words.substr(0, words.size() - ending.size());
        // "joint knee os femoris tibia": of bones that fit, those with the longest names are meant.
        if (joint.parent >= 0 && key.size() >= joint.key.size()) continue;
        joint.key = key;
        joint.parent = p;
        joint.child = c;
      }
    }
    if (std::any_of(marks.joints.begin(), marks.joints.end(), [&](const auto& j) { return j.key == joint.key; })) {
      throw refused(markup, words, "is the second joint of that name");
    }
    marks.joints.push_back(std::move(joint));
  }

  std::vector<std::string> bones_, muscles_;
};

}  // namespace

LimbMarks understand_markups(const std::vector<Markup>& markups, const std::vector<std::string>& bone_keys,
                             const std::vector<std::string>& muscle_keys) {
  Reader reader(bone_keys, muscle_keys);
  for (const Markup& markup : markups) reader.read(markup);
  return std::move(reader.marks);
}

}  // namespace myotact::prepare

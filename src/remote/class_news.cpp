#include "remote/class_news.h"

#include <nlohmann/json.hpp>

namespace myotact::remote {

std::optional<ClassNews> class_news(const std::string& announcement) {
  const nlohmann::json said = nlohmann::json::parse(announcement, nullptr, false);
  if (!said.is_object() || !said.contains("class") || !said["class"].is_object()) return std::nullopt;
  const nlohmann::json& of_class = said["class"];
  ClassNews news;
  const auto join = of_class.find("join"), students = of_class.find("students"), up = of_class.find("hands_up");
  if (join != of_class.end() && join->is_string()) news.join_link = join->get<std::string>();
  if (students != of_class.end() && students->is_number_unsigned()) news.students = students->get<std::size_t>();
  if (up != of_class.end() && up->is_array()) news.hands_up = up->size();
  return news;
}

}  // namespace myotact::remote

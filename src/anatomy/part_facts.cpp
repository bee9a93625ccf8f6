#include "anatomy/part_facts.h"

#include <nlohmann/json.hpp>

#include "core/json_reader.h"

namespace myotact::anatomy {

namespace {

PartFacts read_facts(const JsonValue& value) {
  JsonObject part(value);
  PartFacts facts;
  if (const auto synonyms = part.find("synonyms")) facts.synonyms = synonyms->strings();
  facts.region = part.string_or("region", "");
  facts.function = part.string_or("function", "");
  facts.origin = part.string_or("origin", "");
  facts.insertion = part.string_or("insertion", "");
  facts.action = part.string_or("action", "");
  facts.innervation = part.string_or("innervation", "");
  part.finish();
  return facts;
}

}  // namespace

FactsByKey load_part_facts(const std::filesystem::path& file) {
  const nlohmann::json json = read_json(file);
  JsonObject root{JsonValue(json, file.string())};
  root.at("schema").integer_between(1, 1);
  root.at("sources").strings();  // for the reader of the file
  FactsByKey facts;
  JsonObject parts(root.at("parts"));
  for (const auto& [key, value] : parts.entries()) facts.emplace(key, read_facts(value));
  root.finish();
  return facts;
}

const PartFacts& facts_of(const FactsByKey& facts, const std::string& key) {
  static const PartFacts kNothing;
  const auto found = facts.find(key);
  return found == facts.end() ? kNothing : found->second;
}

}  // namespace myotact::anatomy

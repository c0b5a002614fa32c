#include "processes/redbee/vehicle/sender_rule.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <tuple>

namespace redbee {
namespace {

using Json = nlohmann::json;

using Chain = std::tuple<std::string, std::string, std::string>;  // family, table, name

/// `name`: the member of `of` that names the chain.
Chain chainOf(const Json& of, const char* name) {
  return {of.value("family", ""), of.value("table", ""), of.value(name, "")};
}

bool isMatch(const Json& expression, const char* op, const Json& left) {
  return expression.contains("match") && expression["match"].value("op", "") == op &&
         expression["match"].value("left", Json()) == left;
}

std::optional<std::string> onlySenderOf(const Json& expressions, int port) {
  static const Json kPort = {{"payload", {{"protocol", "udp"}, {"field", "dport"}}}};
  static const Json kUser = {{"meta", {{"key", "skuid"}}}};
  const bool is_ours = expressions.size() == 3 && isMatch(expressions[0], "==", kPort) &&
                       expressions[0]["match"].value("right", Json()) == port &&
                       isMatch(expressions[1], "!=", kUser) && expressions[2].contains("drop");
  if (!is_ours) return std::nullopt;
  const Json user = expressions[1]["match"].value("right", Json());
  return user.is_string() ? user.get<std::string>() : user.dump();
}

}  // namespace

std::optional<int> portOf(const std::string& url) {
  static const std::regex kPattern("udpm://[^:/?]*:([0-9]{1,5})([?].*)?");
  std::smatch found;
  if (!std::regex_match(url, found, kPattern)) return std::nullopt;
  return std::stoi(found[1]);
}

std::optional<std::string> onlySender(const std::string& ruleset, int port) {
  const Json json = Json::parse(ruleset, nullptr, false);
  if (!json.is_object() || !json.contains("nftables")) return std::nullopt;
  std::set<Chain> on_output;
  for (const Json& entry : json["nftables"]) {
    if (entry.contains("chain") && entry["chain"].value("hook", "") == "output") {
      on_output.insert(chainOf(entry["chain"], "name"));
    }
    if (!entry.contains("rule") || !entry["rule"].contains("expr")) continue;
    const Json& rule = entry["rule"];
    if (on_output.count(chainOf(rule, "chain")) == 0) continue;
    if (auto user = onlySenderOf(rule["expr"], port)) return user;
  }
  return std::nullopt;
}

std::string readRuleset() {
  const std::unique_ptr<FILE, int (*)(FILE*)> nft(popen("nft -j list ruleset 2>/dev/null", "r"), pclose);
  std::string text;
  if (!nft) return text;
  std::array<char, 4096> part{};
  while (const size_t n = std::fread(part.data(), 1, part.size(), nft.get())) text.append(part.data(), n);
  return text;
}

}  // namespace redbee

#pragma once

#include <map>
#include <string>

namespace myotact::net {

/// A file that browsers get, made ready once and sent as it is.
struct WebFile {
  std::string content_type;  // "text/html; charset=utf-8"
  std::string body;
  std::string gzip;  // the same, by gzip; for browsers that take it
  std::string tag;   // of these bytes, in quotes: a browser that has them is told so
};

/// By path, "/" first of all. Whole in memory: a request can name nothing else.
using WebFiles = std::map<std::string, WebFile>;

WebFile web_file(std::string content_type, std::string body);

/// What a page may load and do, as the header Content-Security-Policy has it: from here alone, and no script, style or
/// frame that stands in a text. `host`: that of the request, under which its WebSocket is opened.
std::string security_policy(const std::string& host);

}  // namespace myotact::net

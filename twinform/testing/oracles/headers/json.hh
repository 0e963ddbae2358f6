// Values as JSON text, with NaN and Infinity as Python reads them.
#pragma once

#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

namespace json {

inline std::string quoted(const std::string &text) {
  std::string out = "\"";
  for (const unsigned char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += static_cast<char>(c);
    } else if (c < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", c);
      out += escape;
    } else {
      out += static_cast<char>(c);
    }
  }
  return out + "\"";
}

inline std::string number(const double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

// what is written already, separated by commas
inline std::string list(const std::vector<std::string> &values) {
  std::string out;
  for (const std::string &value : values) out += (out.empty() ? "" : ", ") + value;
  return "[" + out + "]";
}

inline std::string member(const std::string &name, const std::string &value) { return quoted(name) + ": " + value; }

inline std::string object(const std::vector<std::string> &members) {
  const std::string inside = list(members);
  return "{" + inside.substr(1, inside.size() - 2) + "}";
}

}  // namespace json

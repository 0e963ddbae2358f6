// Loads files with libsdformat 12 and says what it thinks of each, one JSON object per line.
// File names come from the arguments, or from standard input, one per line.
#include <cstdio>
#include <iostream>
#include <sdf/sdf.hh>
#include <string>

namespace {

std::string quoted(const std::string &text) {
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

void judge(const std::string &path) {
  sdf::Root root;
  const sdf::Errors errors = root.Load(path);
  std::cout << "{\"path\": " << quoted(path) << ", \"ok\": " << (errors.empty() ? "true" : "false") << ", \"errors\": [";
  const char *separator = "";
  for (const sdf::Error &error : errors) {
    std::cout << separator << "{\"code\": " << static_cast<int>(error.Code())
              << ", \"message\": " << quoted(error.Message()) << "}";
    separator = ", ";
  }
  std::cout << "]}" << std::endl;
}

}  // namespace

int main(int count, char **arguments) {
  for (int i = 1; i < count; ++i) judge(arguments[i]);
  std::string path;
  while (count == 1 && std::getline(std::cin, path)) judge(path);
  return 0;
}

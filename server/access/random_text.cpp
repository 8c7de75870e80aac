#include "server/access/random_text.h"

#include <random>
#include <string_view>

namespace throng::server {

std::string random_text(std::size_t length) {
  constexpr std::string_view kLetters = "abcdefghijkmnpqrstuvwxyz23456789";  // 32, none alike
  std::random_device random;
  std::string text;
  for (std::size_t i = 0; i < length; ++i) text += kLetters[random() % kLetters.size()];
  return text;
}

}  // namespace throng::server

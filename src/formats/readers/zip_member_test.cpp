#include "formats/readers/zip_member.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>

namespace parvis::formats {
namespace {

std::string number(std::uint32_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += i < 4 ? char(value >> (8 * i) & 0xff) : '\0';
  return bytes;
}

std::string deflated(const std::string& text) {
  std::string packed(compressBound(uLong(text.size())) + 16, '\0');
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = uInt(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data()), stream.avail_out = uInt(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.erase(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

/// An archive of two files, the first stored, the second deflated.
std::string archive(const std::string& first, const std::string& second) {
  std::string bytes, directory;
  int method = 0;
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.rels", first}, {"3D/b.model", second}}) {
    const std::string packed = method == 0 ? text : deflated(text);
    const std::string common = number(20, 2) + number(0, 2) + number(std::uint32_t(method), 2) +
                               number(0, 4) + number(0, 4) + number(std::uint32_t(packed.size()), 4) +
                               number(std::uint32_t(text.size()), 4) + number(std::uint32_t(name.size()), 2) +
                               number(0, 2);
    directory +=
        "PK\1\2" + number(20, 2) + common + number(0, 10) + number(std::uint32_t(bytes.size()), 4) + name;
    bytes += "PK\3\4" + common + name + packed;
    method = 8;
  }
  const std::size_t at = bytes.size();
  return bytes + directory + "PK\5\6" + number(0, 4) + number(2, 2) + number(2, 2) +
         number(std::uint32_t(directory.size()), 4) + number(std::uint32_t(at), 4) + number(0, 2);
}

TEST(ZipMember, TheFrontOfAFileIsFoundByTheEndOfItsName) {
  const std::string packed = archive("stored text", std::string(5000, 'x') + "end");
  EXPECT_EQ(zip_member_front(packed, ".rels", 6), "stored");
  EXPECT_EQ(zip_member_front(packed, ".model", 100), std::string(100, 'x'));
  EXPECT_EQ(zip_member_front(packed, ".model", 9000), std::string(5000, 'x') + "end");
  EXPECT_EQ(zip_member_front(packed, ".xml", 10), std::nullopt);
}

TEST(ZipMember, DamagedArchivesHaveNone) {
  const std::string packed = archive("stored text", std::string(5000, 'x'));
  for (std::size_t size = 0; size < packed.size(); ++size)
    EXPECT_EQ(zip_member_front(packed.substr(0, size), ".model", 100), std::nullopt) << size;
  for (std::size_t i = 0; i < packed.size(); ++i) {
    std::string damaged = packed;
    damaged[i] = char(damaged[i] ^ 0xff);
    const std::optional<std::string> front = zip_member_front(damaged, ".model", 100);
    EXPECT_LE(front.value_or("").size(), 100u) << i;
  }
}

}  // namespace
}  // namespace parvis::formats

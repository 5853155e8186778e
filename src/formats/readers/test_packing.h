// Packs texts as gzip and bzip2 do, for tests of readers.
#pragma once

#include <bzlib.h>
#include <zlib.h>

#include <string>

namespace parvis::formats {

/// One stream of gzip; empty where zlib fails.
inline std::string gzipped(std::string text) {
  constexpr int largest_window = 15, with_gzip_header = 16, usual_memory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, largest_window + with_gzip_header,
                   usual_memory, Z_DEFAULT_STRATEGY) != Z_OK)
    return {};
  std::string packed(deflateBound(&stream, uLong(text.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(text.data());
  stream.avail_in = uInt(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  const bool is_whole = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  const std::size_t size = is_whole ? stream.total_out : 0;
  deflateEnd(&stream);
  return packed.substr(0, size);
}

/// One stream of bzip2; empty where libbz2 fails.
inline std::string bzipped(std::string text) {
  constexpr int block_hundreds_kb = 9;
  std::string packed(text.size() + text.size() / 100 + 600, '\0');  // as its manual asks for
  unsigned size = unsigned(packed.size());
  const int code = BZ2_bzBuffToBuffCompress(packed.data(), &size, text.data(), unsigned(text.size()),
                                            block_hundreds_kb, 0, 0);
  return packed.substr(0, code == BZ_OK ? size : 0);
}

}  // namespace parvis::formats

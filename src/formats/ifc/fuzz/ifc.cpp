// Any bytes as an IFC file: a model or errors, whatever becomes of the worker that IFC++ runs in.
#include "base/fuzz_file.h"
#include "formats/ifc/ifc_reader.h"
#include "formats/readers/isolated_reader.h"
#include "formats/readers/plain_account.h"

namespace {

parvis::Result<parvis::formats::FileContent> read(const std::filesystem::path& file,
                                                  const parvis::formats::ModelReading&,
                                                  parvis::Errors& warnings) {
  return parvis::formats::with_plain_account("IFC", parvis::scene::read_ifc(file, warnings));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".ifc");
  static const parvis::formats::ReadModel isolated = parvis::formats::isolated<read>();
  parvis::Errors warnings;
  (void)isolated(file.with(data, size), {}, warnings);
  return 0;
}

#include "base/file_set.h"

#include "base/partial_file.h"

namespace parvis {

Status write_together(const std::vector<FileContent>& contents,
                      const std::function<Status()>& before_they_appear) {
  std::vector<PartialFile> files;
  files.reserve(contents.size());
  for (const FileContent& content : contents) {
    Result<PartialFile> file = PartialFile::create(content.file);
    if (!file) return file.errors();
    if (Status status = file->write(content.bytes); !status) return status;
    if (Status status = file->sync(); !status) return status;
    files.push_back(*std::move(file));
  }
  if (before_they_appear)
    if (Status status = before_they_appear(); !status) return status;
  for (PartialFile& file : files)
    if (Status status = file.keep(); !status) return status;
  return Ok{};
}

}  // namespace parvis

#include "common/base/files.h"

#include <unistd.h>

#include "common/base/errors.h"
#include "tests/catch.h"
#include "tests/folder.h"

using namespace ramify;
using ramify::test::Folder;

namespace fs = std::filesystem;

namespace {

template <class Error, class F>
std::string message(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("files: outputs appear together and only when committed") {
  const Folder folder;
  const fs::path a = folder.path() / "a.txt";
  const fs::path b = folder.path() / "b.txt";
  {
    OutputFiles files;
    files.add(a) << "one";
    files.add(b) << "two";
    CHECK_FALSE(fs::exists(a));
    files.commit();
  }
  CHECK(read_file(a) == "one");
  CHECK(read_file(b) == "two");
  CHECK(folder.count() == 2);
}

TEST_CASE("files: what is not committed leaves the old file and nothing else") {
  const Folder folder;
  const fs::path a = folder.path() / "a.txt";
  {
    OutputFiles files;
    files.add(a) << "old";
    files.commit();
  }
  {
    OutputFiles files;
    files.add(a) << "new";
  }
  CHECK(read_file(a) == "old");
  CHECK(folder.count() == 1);
}

TEST_CASE("files: what cannot be read or written is named") {
  const Folder folder;
  const std::string path = folder.path().string();
  CHECK(message<InputError>([&] { read_file(folder.path()); }) == path + ": is a folder, not a file");
  CHECK(message<InputError>([&] { read_file(folder.path() / "none"); }) ==
        path + "/none: cannot read: No such file or directory");
  CHECK(message<IoError>([&] { require_writable(folder.path()); }) == path + ": is a folder, not a file");
  CHECK(message<IoError>([&] { require_writable(folder.path() / "no" / "x"); }) ==
        path + "/no/x: cannot write: there is no folder " + path + "/no");
}

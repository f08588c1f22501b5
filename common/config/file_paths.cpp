#include "common/config/file_paths.h"

namespace ramify {

void make_paths_absolute(const Table& table, void* owner) {
  for (const FieldRow& row : table) {
    void* member = row.member(owner);
    switch (row.kind) {
      case FieldKind::path: {
        auto& path = *static_cast<std::filesystem::path*>(member);
        if (!path.empty()) path = std::filesystem::absolute(path).lexically_normal();
        break;
      }
      case FieldKind::group:
        make_paths_absolute(row.child(), member);
        break;
      case FieldKind::list:
        for (std::size_t i = 0; i < row.size(member); ++i)
          make_paths_absolute(row.child(), row.item(member, i));
        break;
      case FieldKind::map:
        for (const std::string& name : row.names(member)) {
          make_paths_absolute(row.child(), row.named(member, name));
        }
        break;
      default:
        break;
    }
  }
}

}  // namespace ramify

#include "common/config/file_paths.h"

namespace ramify {

void for_each_path(const Table& table, void* owner,
                   const std::function<void(std::filesystem::path&)>& visit) {
  for (const FieldRow& row : table) {
    void* member = row.member(owner);
    switch (row.kind) {
      case FieldKind::path: {
        auto& path = *static_cast<std::filesystem::path*>(member);
        if (!path.empty()) visit(path);
        break;
      }
      case FieldKind::group:
        for_each_path(row.child(), member, visit);
        break;
      case FieldKind::list:
        for (std::size_t i = 0; i < row.size(member); ++i)
          for_each_path(row.child(), row.item(member, i), visit);
        break;
      case FieldKind::map:
        for (const std::string& name : row.names(member)) {
          for_each_path(row.child(), row.named(member, name), visit);
        }
        break;
      default:
        break;
    }
  }
}

void make_paths_absolute(const Table& table, void* owner) {
  for_each_path(table, owner, [](std::filesystem::path& path) {
    path = std::filesystem::absolute(path).lexically_normal();
  });
}

}  // namespace ramify

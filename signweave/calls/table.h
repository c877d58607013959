#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace signweave::calls {

/// Rows as aligned columns; the first row is the heading. Columns whose cells are all numbers are aligned right. Widths
/// are counted in terminal columns.
std::string format_table(const std::vector<std::vector<std::string>>& rows);

/// Rows as CSV (RFC 4180).
std::string format_csv(const std::vector<std::vector<std::string>>& rows);

/// "1 recording", "2 recordings".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace signweave::calls

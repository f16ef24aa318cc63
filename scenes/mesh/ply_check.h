#pragma once

#include <string>
#include <string_view>

/// Refuses PLY files at which the importer would not end, would write past its arrays, or would reserve far more memory
/// than they need.
namespace hedgehop::scenes::mesh {

/// Returns why the file cannot be imported; empty if it can. The header must consist of known keywords and types,
/// without triangle strips and with each element once, and no element or list may announce more values than the file
/// has bytes.
std::string fault_of_ply(std::string_view ply);

}  // namespace hedgehop::scenes::mesh

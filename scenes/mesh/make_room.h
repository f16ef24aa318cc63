#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hedgehop::scenes::mesh {

/// Reserves memory for further elements, at least twice the former memory, so that repeated calls cost linear time.
template <class T>
void make_room(std::vector<T>& elements, size_t further) {
  const size_t size = elements.size() + further;
  if (size > elements.capacity()) elements.reserve(std::max(size, 2 * elements.capacity()));
}

}  // namespace hedgehop::scenes::mesh

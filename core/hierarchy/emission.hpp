#pragma once

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/hierarchy.hpp"

namespace raylane::core {

/// Turns a binary tree into wide nodes with padded bounds, following its nodes' decisions, and its
/// leaves into blocks of the lists' shapes. Numbers both by their position in the tree.
void emit(BinaryTree& tree, const ShapeLists& lists, Workers& workers, Hierarchy& hierarchy,
          Tables& tables);

} // namespace raylane::core

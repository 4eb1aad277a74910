#pragma once

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/hierarchy.hpp"

namespace raylane::core {

/// Turns a binary tree, as its nodes have decided, into wide nodes whose bounds are padded, and its
/// leaves into blocks of the lists' shapes. Numbers both by where they are in the tree.
void emit(BinaryTree& tree, const ShapeLists& lists, Workers& workers, Hierarchy& hierarchy,
          Tables& tables);

} // namespace raylane::core

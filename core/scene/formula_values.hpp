#pragma once

#include "core/numbers/formula_program.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace raylane::core {

/// Returns the result of an operation of scalars.
double result_of(FormulaOperation operation, double a, double b, double c);

/// Values of a formula that is being compiled: inputs, constants and results, in any order. Equal
/// values exist once, and operations of constants are constants.
class FormulaValues {
  public:
    /// A value, by its number.
    using Value = int;
    /// A place in the text of a channel.
    struct Place {
        int channel = 0;
        std::size_t at = 0;
    };

    Place place{}; ///< of the values that are added next

    FormulaValues() {
        for (int i = 0; i < FormulaProgram::inputs; ++i)
            values_.push_back({});
    }

    Value constant(double number);
    Value result(FormulaOperation operation, Value a, Value b, Value c);
    Value result(FormulaOperation operation, Value a, Value b) {
        return result(operation, a, b, a);
    }

    /// Returns x^n, n > 0.
    Value power(Value x, int n);
    /// Returns a constant's number.
    std::optional<double> number_of(Value value) const {
        if (!values_[value].is_constant) return std::nullopt;
        return values_[value].constant;
    }

    /// Writes the values that the channels need. Returns the number of instructions and constants
    /// that they need, which may be more than a program can hold.
    struct Count {
        int number = 0;
        Place excess{}; ///< of the first one that a program cannot hold
    };
    struct Size {
        Count instructions, constants;
    };
    Size write(const std::array<Value, 3>& channels, FormulaProgram& program) const;

  private:
    struct Node {
        Place place{};
        bool is_constant = false;
        double constant = 0.0;
        FormulaOperation operation{};
        std::array<Value, 3> operands{};
    };
    Value size() const { return static_cast<Value>(values_.size()); }

    std::vector<Node> values_;
    std::map<std::uint64_t, Value> constants_;
    std::map<std::tuple<FormulaOperation, Value, Value, Value>, Value> results_;
};

} // namespace raylane::core

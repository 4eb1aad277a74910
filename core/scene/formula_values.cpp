#include "core/scene/formula_values.hpp"

#include "core/numbers/primitives.hpp"

#include <bit>
#include <cmath>

namespace raylane::core {

double result_of(FormulaOperation operation, double a, double b, double c) {
    double result = 0.0;
    FormulaOperations<double>::with(operation, [&](const auto& f) { result = f(a, b, c); });
    return result;
}

FormulaValues::Value FormulaValues::constant(double number) {
    const auto [found, is_new] =
        constants_.try_emplace(std::bit_cast<std::uint64_t>(number), size());
    if (is_new) values_.push_back({.place = place, .is_constant = true, .constant = number});
    return found->second;
}

FormulaValues::Value FormulaValues::result(FormulaOperation operation, Value a, Value b, Value c) {
    if (operation == FormulaOperation::choose && values_[a].is_constant)
        return std::abs(values_[a].constant) > 0.0 ? b : c;
    if (values_[a].is_constant && values_[b].is_constant && values_[c].is_constant)
        return constant(
            result_of(operation, values_[a].constant, values_[b].constant, values_[c].constant));
    const auto [found, is_new] = results_.try_emplace(std::tuple(operation, a, b, c), size());
    if (is_new) values_.push_back({.place = place, .operation = operation, .operands = {a, b, c}});
    return found->second;
}

FormulaValues::Value FormulaValues::power(Value x, int n) {
    if (n == 1) return x;
    const Value root = power(x, n / 2), square = result(FormulaOperation::multiply, root, root);
    return n % 2 == 0 ? square : result(FormulaOperation::multiply, square, x);
}

FormulaValues::Size FormulaValues::write(const std::array<Value, 3>& channels,
                                         FormulaProgram& program) const {
    std::vector<bool> needed(values_.size());
    for (const Value channel : channels)
        needed[channel] = true;
    for (Value value = size(); value-- > FormulaProgram::inputs;)
        if (needed[value] && !values_[value].is_constant)
            for (const Value operand : values_[value].operands)
                needed[operand] = true;

    Size size_of_all;
    const auto add = [](Count& count, int most, const Node& node) {
        if (++count.number == most + 1) count.excess = node.place;
    };
    for (Value value = FormulaProgram::inputs; value < size(); ++value) {
        const Node& node = values_[value];
        if (needed[value] && node.is_constant)
            add(size_of_all.constants, FormulaProgram::max_constants, node);
        else if (needed[value])
            add(size_of_all.instructions, FormulaProgram::max_instructions, node);
    }
    if (size_of_all.instructions.number > FormulaProgram::max_instructions ||
        size_of_all.constants.number > FormulaProgram::max_constants)
        return size_of_all;

    std::vector<std::uint8_t> number(values_.size());
    for (int i = 0; i < FormulaProgram::inputs; ++i)
        number[i] = static_cast<std::uint8_t>(i);
    for (Value value = FormulaProgram::inputs; value < size(); ++value) {
        if (!needed[value] || !values_[value].is_constant) continue;
        number[value] = static_cast<std::uint8_t>(FormulaProgram::inputs + program.constant_count);
        program.constants[program.constant_count++] = values_[value].constant;
    }
    for (Value value = FormulaProgram::inputs; value < size(); ++value) {
        const Node& node = values_[value];
        if (!needed[value] || node.is_constant) continue;
        number[value] = static_cast<std::uint8_t>(
            FormulaProgram::inputs + size_of_all.constants.number + program.instruction_count);
        program.instructions[program.instruction_count++] = {
            node.operation, number[node.operands[0]], number[node.operands[1]],
            number[node.operands[2]]};
    }
    for (int channel = 0; channel < 3; ++channel)
        program.channels[channel] = number[channels[channel]];
    program.needs_shape = needed[3] || needed[4];
    return size_of_all;
}

} // namespace raylane::core

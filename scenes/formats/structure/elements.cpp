#include "scenes/formats/structure/elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace raylane::scenes {

namespace {

constexpr std::array<ElementData, element_count> elements = {{
    {"X", 0.00F, 0.00F, 0.000F, 0xff1493},    {"H", 0.31F, 1.20F, 1.008F, 0xffffff},
    {"He", 0.28F, 1.40F, 4.003F, 0xd9ffff},   {"Li", 1.28F, 1.82F, 6.940F, 0xcc80ff},
    {"Be", 0.96F, 1.53F, 9.012F, 0xc2ff00},   {"B", 0.84F, 1.92F, 10.810F, 0xffb5b5},
    {"C", 0.76F, 1.70F, 12.011F, 0x909090},   {"N", 0.71F, 1.55F, 14.007F, 0x3050f8},
    {"O", 0.66F, 1.52F, 15.999F, 0xff0d0d},   {"F", 0.57F, 1.47F, 18.998F, 0x90e050},
    {"Ne", 0.58F, 1.54F, 20.180F, 0xb3e3f5},  {"Na", 1.66F, 2.27F, 22.990F, 0xab5cf2},
    {"Mg", 1.41F, 1.73F, 24.305F, 0x8aff00},  {"Al", 1.21F, 1.84F, 26.982F, 0xbfa6a6},
    {"Si", 1.11F, 2.10F, 28.085F, 0xf0c8a0},  {"P", 1.07F, 1.80F, 30.974F, 0xff8000},
    {"S", 1.05F, 1.80F, 32.060F, 0xffff30},   {"Cl", 1.02F, 1.75F, 35.450F, 0x1ff01f},
    {"Ar", 1.06F, 1.88F, 39.948F, 0x80d1e3},  {"K", 2.03F, 2.75F, 39.098F, 0x8f40d4},
    {"Ca", 1.76F, 2.31F, 40.078F, 0x3dff00},  {"Sc", 1.70F, 2.58F, 44.956F, 0xe6e6e6},
    {"Ti", 1.60F, 2.46F, 47.867F, 0xbfc2c7},  {"V", 1.53F, 2.42F, 50.941F, 0xa6a6ab},
    {"Cr", 1.39F, 2.45F, 51.996F, 0x8a99c7},  {"Mn", 1.39F, 2.45F, 54.938F, 0x9c7ac7},
    {"Fe", 1.32F, 2.44F, 55.845F, 0xe06633},  {"Co", 1.26F, 2.40F, 58.933F, 0xf090a0},
    {"Ni", 1.24F, 1.63F, 58.693F, 0x50d050},  {"Cu", 1.32F, 1.40F, 63.546F, 0xc88033},
    {"Zn", 1.22F, 1.39F, 65.380F, 0x7d80b0},  {"Ga", 1.22F, 1.87F, 69.723F, 0xc28f8f},
    {"Ge", 1.20F, 2.11F, 72.630F, 0x668f8f},  {"As", 1.19F, 1.85F, 74.922F, 0xbd80e3},
    {"Se", 1.20F, 1.90F, 78.971F, 0xffa100},  {"Br", 1.20F, 1.85F, 79.904F, 0xa62929},
    {"Kr", 1.16F, 2.02F, 83.798F, 0x5cb8d1},  {"Rb", 2.20F, 3.03F, 85.468F, 0x702eb0},
    {"Sr", 1.95F, 2.49F, 87.620F, 0x00ff00},  {"Y", 1.90F, 2.75F, 88.906F, 0x94ffff},
    {"Zr", 1.75F, 2.52F, 91.224F, 0x94e0e0},  {"Nb", 1.64F, 2.56F, 92.906F, 0x73c2c9},
    {"Mo", 1.54F, 2.45F, 95.950F, 0x54b5b5},  {"Tc", 1.47F, 2.44F, 97.907F, 0x3b9e9e},
    {"Ru", 1.46F, 2.46F, 101.070F, 0x248f8f}, {"Rh", 1.42F, 2.44F, 102.906F, 0x0a7d8c},
    {"Pd", 1.39F, 1.63F, 106.420F, 0x006985}, {"Ag", 1.45F, 1.72F, 107.868F, 0xc0c0c0},
    {"Cd", 1.44F, 1.58F, 112.414F, 0xffd98f}, {"In", 1.42F, 1.93F, 114.818F, 0xa67573},
    {"Sn", 1.39F, 2.17F, 118.710F, 0x668080}, {"Sb", 1.39F, 2.06F, 121.760F, 0x9e63b5},
    {"Te", 1.38F, 2.06F, 127.600F, 0xd47a00}, {"I", 1.39F, 1.98F, 126.904F, 0x940094},
    {"Xe", 1.40F, 2.16F, 131.293F, 0x429eb0}, {"Cs", 2.44F, 3.43F, 132.905F, 0x57178f},
    {"Ba", 2.15F, 2.49F, 137.327F, 0x00c900}, {"La", 2.07F, 2.98F, 138.905F, 0x70d4ff},
    {"Ce", 2.04F, 2.88F, 140.116F, 0xffffc7}, {"Pr", 2.03F, 2.92F, 140.908F, 0xd9ffc7},
    {"Nd", 2.01F, 2.95F, 144.242F, 0xc7ffc7}, {"Pm", 1.99F, 0.00F, 144.913F, 0xa3ffc7},
    {"Sm", 1.98F, 2.90F, 150.360F, 0x8fffc7}, {"Eu", 1.98F, 2.87F, 151.964F, 0x61ffc7},
    {"Gd", 1.96F, 2.83F, 157.250F, 0x45ffc7}, {"Tb", 1.94F, 2.79F, 158.925F, 0x30ffc7},
    {"Dy", 1.92F, 2.87F, 162.500F, 0x1fffc7}, {"Ho", 1.92F, 2.81F, 164.930F, 0x00ff9c},
    {"Er", 1.89F, 2.83F, 167.259F, 0x00e675}, {"Tm", 1.90F, 2.79F, 168.934F, 0x00d452},
    {"Yb", 1.87F, 2.80F, 173.054F, 0x00bf38}, {"Lu", 1.87F, 2.74F, 174.967F, 0x00ab24},
    {"Hf", 1.75F, 2.63F, 178.490F, 0x4dc2ff}, {"Ta", 1.70F, 2.53F, 180.948F, 0x4da6ff},
    {"W", 1.62F, 2.57F, 183.840F, 0x2194d6},  {"Re", 1.51F, 2.49F, 186.207F, 0x267dab},
    {"Os", 1.44F, 2.48F, 190.230F, 0x266696}, {"Ir", 1.41F, 2.41F, 192.217F, 0x175487},
    {"Pt", 1.36F, 1.75F, 195.084F, 0xd0d0e0}, {"Au", 1.36F, 1.66F, 196.967F, 0xffd123},
    {"Hg", 1.32F, 1.55F, 200.592F, 0xb8b8d0}, {"Tl", 1.45F, 1.96F, 204.380F, 0xa6544d},
    {"Pb", 1.46F, 2.02F, 207.200F, 0x575961}, {"Bi", 1.48F, 2.07F, 208.980F, 0x9e4fb5},
    {"Po", 1.40F, 1.97F, 208.982F, 0xab5c00}, {"At", 1.50F, 2.02F, 209.987F, 0x754f45},
    {"Rn", 1.50F, 2.20F, 222.018F, 0x428296}, {"Fr", 2.60F, 3.48F, 223.020F, 0x420066},
    {"Ra", 2.21F, 2.83F, 226.025F, 0x007d00}, {"Ac", 2.15F, 2.80F, 227.028F, 0x70abfa},
    {"Th", 2.06F, 2.93F, 232.038F, 0x00baff}, {"Pa", 2.00F, 2.88F, 231.036F, 0x00a1ff},
    {"U", 1.96F, 1.86F, 238.029F, 0x008fff},  {"Np", 1.90F, 2.82F, 237.048F, 0x0080ff},
    {"Pu", 1.87F, 2.81F, 244.064F, 0x006bff}, {"Am", 1.80F, 2.83F, 243.061F, 0x545cf2},
    {"Cm", 1.69F, 3.05F, 247.070F, 0x785ce3}, {"Bk", 0.00F, 3.40F, 247.070F, 0x8a4fe3},
    {"Cf", 0.00F, 3.05F, 251.080F, 0xa136d4}, {"Es", 0.00F, 2.70F, 252.083F, 0xb31fd4},
    {"Fm", 0.00F, 0.00F, 257.095F, 0xb31fba}, {"Md", 0.00F, 0.00F, 258.098F, 0xb30da6},
    {"No", 0.00F, 0.00F, 259.101F, 0xbd0d87}, {"Lr", 0.00F, 0.00F, 262.110F, 0xc70066},
    {"Rf", 0.00F, 0.00F, 267.122F, 0xcc0059}, {"Db", 0.00F, 0.00F, 268.126F, 0xd1004f},
    {"Sg", 0.00F, 0.00F, 271.134F, 0xd90045}, {"Bh", 0.00F, 0.00F, 270.133F, 0xe00038},
    {"Hs", 0.00F, 0.00F, 269.134F, 0xe6002e}, {"Mt", 0.00F, 0.00F, 278.156F, 0xeb0026},
    {"Ds", 0.00F, 0.00F, 281.165F, 0xeb0026}, {"Rg", 0.00F, 0.00F, 281.166F, 0xeb0026},
    {"Cn", 0.00F, 0.00F, 285.177F, 0xeb0026}, {"Nh", 0.00F, 0.00F, 286.182F, 0xeb0026},
    {"Fl", 0.00F, 0.00F, 289.190F, 0xeb0026}, {"Mc", 0.00F, 0.00F, 289.194F, 0xeb0026},
    {"Lv", 0.00F, 0.00F, 293.204F, 0xeb0026}, {"Ts", 0.00F, 0.00F, 293.208F, 0xeb0026},
    {"Og", 0.00F, 0.00F, 294.214F, 0xeb0026},
}};

constexpr std::pair<Element, float> known_metallic_radii[] = {
    {3, 1.52F},   {4, 1.12F},   {11, 1.86F},  {12, 1.60F},  {13, 1.43F},  {19, 2.27F},
    {20, 1.97F},  {21, 1.62F},  {22, 1.47F},  {23, 1.34F},  {24, 1.28F},  {25, 1.27F},
    {26, 1.26F},  {27, 1.25F},  {28, 1.24F},  {29, 1.28F},  {30, 1.34F},  {31, 1.35F},
    {37, 2.48F},  {38, 2.15F},  {39, 1.80F},  {40, 1.60F},  {41, 1.46F},  {42, 1.39F},
    {43, 1.36F},  {44, 1.34F},  {45, 1.34F},  {46, 1.37F},  {47, 1.44F},  {48, 1.51F},
    {49, 1.67F},  {55, 2.65F},  {56, 2.22F},  {57, 1.87F},  {58, 1.818F}, {59, 1.824F},
    {60, 1.814F}, {61, 1.834F}, {62, 1.804F}, {63, 1.804F}, {64, 1.804F}, {65, 1.773F},
    {66, 1.781F}, {67, 1.762F}, {68, 1.761F}, {69, 1.759F}, {70, 1.76F},  {71, 1.738F},
    {72, 1.59F},  {73, 1.46F},  {74, 1.39F},  {75, 1.37F},  {76, 1.35F},  {77, 1.355F},
    {78, 1.385F}, {79, 1.44F},  {80, 1.51F},  {81, 1.70F},  {82, 1.75F},  {90, 1.79F},
    {91, 1.63F},  {92, 1.56F},  {93, 1.55F},  {94, 1.59F},  {95, 1.73F},  {96, 1.74F}};

constexpr std::array<float, element_count> metallic_radii = [] {
    std::array<float, element_count> radii{};
    for (std::size_t z = 0; z < radii.size(); ++z)
        radii[z] = elements[z].covalent_radius;
    for (const auto& [element, radius] : known_metallic_radii)
        radii[element] = radius;
    return radii;
}();

constexpr int heaviest = 99; // einsteinium: samples have no heavier elements

/// In daltons, of isotopes that samples have: D, T, lithium's, boron's, and carbon's.
constexpr std::pair<double, Element> isotopes[] = {{2.014, 1},  {3.016, 1},  {6.015, 3}, {7.016, 3},
                                                   {10.013, 5}, {11.009, 5}, {13.003, 6}};

bool is_whole(double number) {
    return std::abs(number - std::round(number)) <= 1e-9 * std::abs(number);
}

/// Returns the only element whose mass rounds to the same whole number, or 0.
Element element_of_whole_mass(double mass) {
    Element found = 0;
    for (int z = 1; z <= heaviest; ++z)
        if (std::round(static_cast<double>(elements[static_cast<std::size_t>(z)].mass)) ==
            std::round(mass)) {
            if (found != 0) return 0;
            found = static_cast<Element>(z);
        }
    return found;
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

} // namespace

const ElementData& data_of(Element element) {
    return elements[element < element_count ? element : 0];
}

bool is_metal(Element z) {
    return z == 3 || z == 4 || (z >= 11 && z <= 13) || (z >= 19 && z <= 31) ||
           (z >= 37 && z <= 50) || (z >= 55 && z <= 84) || z >= 87;
}

float metallic_radius(Element element) {
    return metallic_radii[element < element_count ? element : 0];
}

Element element_of(std::string_view symbol) {
    const auto is_same = [&](const ElementData& data) {
        return std::equal(data.symbol.begin(), data.symbol.end(), symbol.begin(), symbol.end(),
                          [](char a, char b) { return lower(a) == lower(b); });
    };
    const auto* const found = std::find_if(elements.begin() + 1, elements.end(), is_same);
    if (found != elements.end()) return static_cast<Element>(found - elements.begin());
    return symbol.size() == 1 && (lower(symbol[0]) == 'd' || lower(symbol[0]) == 't') ? 1 : 0;
}

Element element_of_mass(double mass) {
    if (is_whole(mass)) return element_of_whole_mass(mass);
    for (const auto& [of_isotope, element] : isotopes)
        if (std::abs(of_isotope - mass) <= 0.003) return element;
    const auto off = [&](const ElementData& element) {
        return std::abs(static_cast<double>(element.mass) - mass);
    };
    const auto* const nearest = std::min_element(
        elements.begin() + 1, elements.begin() + heaviest + 1,
        [&](const ElementData& a, const ElementData& b) { return off(a) < off(b); });
    // Old tables differ by less than 0.1 %. CH2 differs from nitrogen by more.
    const bool is_near = off(*nearest) <= std::min(0.05, 0.001 * mass);
    const bool is_rounded = (is_whole(10.0 * mass) && off(*nearest) <= 0.0501) ||
                            (is_whole(100.0 * mass) && off(*nearest) <= 0.0051);
    return is_near || is_rounded ? static_cast<Element>(nearest - elements.begin()) : Element{0};
}

std::vector<Element> elements_of_masses(const std::vector<double>& masses, MassUnits units) {
    if (units == MassUnits::others) return {};
    std::vector<Element> found;
    bool has_decimals = false, has_usual = false, has_different = false;
    bool has_one = false, has_hydrogen = false;
    for (const double mass : masses) {
        found.push_back(element_of_mass(mass));
        if (found.back() == 0) return {};
        has_decimals = has_decimals || !is_whole(mass);
        has_usual = has_usual || mass == 12.0 || mass == 16.0;
        has_different = has_different || mass != masses.front();
        has_one = has_one || mass == 1.0;
        has_hydrogen = has_hydrogen || (found.back() == 1 && mass > 1.0 && mass < 1.5);
    }
    if (units == MassUnits::daltons) return found;
    if (masses.size() > 1 && !has_different) return {};
    if (std::all_of(masses.begin(), masses.end(), [](double mass) { return mass < 1.5; }))
        return {};
    if (has_one && has_hydrogen) return {}; // electrons have mass 1 beside nuclei
    if (!has_decimals && !(has_usual && has_different)) return {};
    return found;
}

} // namespace raylane::scenes

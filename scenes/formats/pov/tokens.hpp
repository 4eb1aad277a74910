#pragma once

#include "scenes/files/included_files.hpp"
#include "scenes/formats/pov/budget.hpp"
#include "scenes/formats/pov/includes.hpp"
#include "scenes/formats/pov/value.hpp"

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <unordered_map>

namespace raylane::scenes::pov {

/// Limits far above those of any realistic scene.
inline constexpr int deepest = 128; ///< of nested statements, expressions and macros
inline constexpr std::size_t max_shapes = std::size_t{1} << 24; ///< of an object
inline constexpr std::size_t max_lights = std::size_t{1} << 16;
inline constexpr std::size_t max_elements = std::size_t{1} << 20;
inline constexpr std::size_t longest_string = std::size_t{1} << 16;

/// Counts a nested level during its lifetime. Fails above `deepest`.
class Level {
  public:
    Level(int& depth, const Place& place) : depth_(depth) {
        if (depth_ >= deepest)
            fail(place, "must not be nested more than " + std::to_string(deepest) + " deep");
        ++depth_;
    }
    ~Level() { --depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

  private:
    int& depth_;
};

/// The tokens of a scene with its directives executed: files included, names declared, macros and
/// loops expanded.
class Tokens {
  public:
    Tokens(Source source, const OnRemark& on_remark);

    /// Returns the next token. Macros are expanded.
    Token next();
    const Token& peek();
    /// Returns the next token of an expression, after executing all directives before it. In a
    /// #declare or #version, and outside of brackets, a directive that may use the declared name
    /// ends the expression. The token is then the '#' of that directive. Macros are not expanded.
    const Token& ahead();
    bool at(std::string_view what) { return peek().is(what); }
    /// Takes the next token and returns true if it is `what`. Otherwise takes nothing and returns
    /// false.
    bool accept(std::string_view what);
    void expect(std::string_view what);
    /// Returns true if the token `what` follows the word that `peek` has returned.
    bool is_before(std::string_view what) const;
    /// Skips braces and everything between them.
    void skip_braces();

    /// Returns null for undeclared names.
    const Value* find(std::string_view name) const;
    /// Returns the value of a name or of an array's element; null for other tokens. The value of an
    /// element is valid until the next element is read.
    const Value* value_of(const Token& token) const;
    /// Takes and returns the next value. Returns null, and takes nothing, if it has another type.
    template <class T>
    Shared<T> accept_value() {
        const Value* value = value_of(peek());
        const Shared<T>* known = value != nullptr ? value->get_if<Shared<T>>() : nullptr;
        if (known == nullptr) return nullptr;
        Shared<T> found = *known;
        next();
        return found;
    }
    /// Reads "(NAME)" or "(NAME[0])" from the bracket on. Returns true if there is such a value.
    bool read_is_declared();
    void declare(std::string_view name, Value value, bool is_local);
    /// Returns a value to keep under another name. Copies an array, so that no array contains
    /// itself.
    Value copied(Value value, const Place& place);
    /// Reads "function(A, B) { EXPRESSION }" behind the word, and returns a macro. A function of a
    /// pigment or the like is not rendered.
    Value read_function_value();
    /// Declares a name in the current scope.
    void declare_here(std::string_view name, Value value);

    /// Reports, once, a feature that is rendered differently from POV-Ray.
    void remark(const Place& place, const std::string& what);

    /// Begins a stream of random numbers, and returns the stream's number.
    double begin_random(std::uint32_t seed);
    /// Returns a random number from 0 to 1.
    double next_random(double stream, const Place& place);

    Budget budget;
    int depth = 0;         ///< nested statements, expressions and macros
    int open_brackets = 0; ///< brackets that are not closed yet
    /// Version of the language, set by the last #version. Without #version, POV-Ray 3.7 treats the
    /// scene as one of 3.62, but the word `version` is 3.7.
    std::optional<double> version;
    std::optional<double> assumed_gamma; ///< set by global_settings; 0: sRGB's curve
    /// Returns the gamma of the scene's colours. 0: they are the file's codes, which is the default
    /// of versions before 3.7.
    double gamma() const {
        return assumed_gamma.value_or(version.value_or(3.62) < 3.7 ? 0.0 : 1.0);
    }
    /// Mean colours of images, by the path of the file and whether its sRGB codes were decoded to
    /// linear values before taking the mean.
    std::map<std::pair<std::string, bool>, std::optional<Tuple>> image_colors;
    Shared<Texture> default_texture = std::make_shared<const Texture>();
    /// Returns a file beside the one that names it, or beside the scene.
    std::optional<std::filesystem::path> file_beside(const std::string& name,
                                                     const Place& place) const;
    /// Returns the end of an error message, which names the included file of POV-Ray's own that
    /// declares the unsupported name `name`. Returns an empty text if no such file declares it.
    std::string origin_of(const Token& name) const;
    /// Returns true for a file that raylane has written, by its first words.
    bool is_by_convert() const;
    const Source& main() const { return sources_.front(); }

  private:
    struct Condition {
        enum class Kind : std::uint8_t { choice, switch_case, while_loop, for_loop } kind;
        Place place{};
        std::optional<Scanner> again{}; ///< loops
        std::string_view counter{};     ///< for
        double last = 0.0, step = 0.0;  ///< for
    };
    /// A name of an outer scope that a parameter stands for.
    struct Alias {
        std::string_view parameter;
        std::size_t frame, serial; ///< a frame with another serial is a different one
        std::string_view name;
    };
    enum class FrameKind : std::uint8_t { file, macro, function };
    struct Frame {
        Scanner scanner;
        FrameKind kind;
        Place place{};
        std::vector<Condition> conditions{};
        std::unordered_map<std::string_view, Value> names{};
        std::vector<Alias> aliases{};
        std::size_t serial = 0; ///< unique
    };
    /// The place where a name is declared, if it is.
    struct Found {
        const Value* value = nullptr;
        std::size_t frame = 0;
        std::string_view name{};
    };

    Found found(std::string_view name) const;
    Token expanded();
    Token element_of(Token name, std::shared_ptr<Array> array);
    void assign(Array& array, std::span<const std::size_t> indices, Value value, const Token& name);
    bool ends_expression(const Token& directive) const;
    void read_argument(Frame& frame, std::string_view parameter);
    Token raw();
    Token raw_word(const char* what);
    bool leave_frame(const Place& end);
    void directive(const Place& hash);
    void declaration(const Token& word);
    void file_directive(const Token& word);
    void begin_macro();
    /// Takes the macro by value: an argument may redeclare the macro's name.
    void call(Shared<Macro> macro, const Place& place);
    void include();
    void open(const std::string& name, const Place& place);
    void include_standard(const StandardFile& file);
    bool declare_standard(const Token& name);
    void begin_if(bool holds, const Place& place);
    void begin_switch(const Place& place);
    void begin_while(const Place& place);
    void begin_for(const Place& place);
    void leave_loop(const Place& place);
    void end(const Place& place);
    enum class Until : std::uint8_t { end, branch, switch_case };
    Token skip_to(const Place& place, Until until);
    bool condition();
    /// Reads one or two numbers.
    std::array<double, 2> read_in_parentheses();
    void enter(Frame frame);

    std::deque<Source> sources_; ///< tokens and names refer to their texts
    std::vector<Frame> frames_;
    std::optional<Token> peeked_;
    Value element_;            ///< of the last `element` token
    bool is_expanded_ = false; ///< the peeked token: no directive, no macro's name
    int declared_at_ = -1;     ///< open brackets around the #declare whose value is read
    const OnRemark& on_remark_;
    std::set<std::string> remarks_;
    std::map<std::string, const Source*> included_;
    IncludedFiles opener_;
    std::vector<std::uint32_t> random_; ///< the state of each stream
    /// A name that one of POV-Ray's own files declares. It is declared when it is first used.
    struct StandardName {
        std::string_view file, declaration; ///< empty: not supported
    };
    std::unordered_map<std::string_view, StandardName> standard_names_;
    std::set<std::string_view> standard_files_; ///< that are included
    std::optional<Place> standard_use_; ///< the use for which a standard name is being declared
    std::size_t frames_entered_ = 0;
};

/// Reads a value as allowed behind "#declare NAME =", or as an argument of a macro.
Value read_value(Tokens& tokens);
/// Stores a copied value in an array.
void set_element(Budget& budget, Array& array, std::size_t index, Value value, const Place& place);

} // namespace raylane::scenes::pov

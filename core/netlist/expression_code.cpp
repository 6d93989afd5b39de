#include "core/netlist/expression_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/netlist/characters.hpp"

namespace rheonet {

namespace {

constexpr int most_parentheses = 500;  // the parser recurses for each
// Limit on nested signs, powers and choices; a parenthesis counts as at least two levels.
constexpr int most_levels_within = 4 * most_parentheses;

bool begins_name(char c) { return is_letter(c) || c == '_'; }

struct ExpressionToken {
  enum class Kind { number, name, sign, end };
  Kind kind;
  ExpressionCode::Part part;
  double number = 0;
};

[[noreturn]] void refuse_at(std::size_t byte, std::string_view text, std::string message, std::string hint = "") {
  throw TextError{count_characters(text.substr(0, byte)), std::move(message), std::move(hint)};
}

/// Splits a text into numbers, names and signs.
class ExpressionScanner {
 public:
  explicit ExpressionScanner(std::string_view text) : text_(text) {}

  std::vector<ExpressionToken> run() {
    std::vector<ExpressionToken> tokens;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n')
        ++at_;
      else if (is_digit(c) || (c == '.' && is_digit(next())))
        tokens.push_back(number());
      else if (begins_name(c))
        tokens.push_back(name());
      else
        tokens.push_back(sign());
    }
    tokens.push_back({ExpressionToken::Kind::end, {text_.size(), text_.size()}});
    return tokens;
  }

 private:
  char next() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\0'; }

  ExpressionToken number() {
    const std::size_t begin = at_;
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(end - text_.data());
    const std::string_view digits = text_.substr(begin, at_ - begin);
    if (at_ < text_.size() && begins_name(text_[at_])) {
      std::size_t last = at_;
      while (last < text_.size() && (begins_name(text_[last]) || is_digit(text_[last]))) ++last;
      const std::string_view name = text_.substr(at_, last - at_);
      refuse_at(at_, text_, fmt::format("`{}` follows a number without an operator", name),
           fmt::format("`{0}*{1}` for a parameter, `{0} {1}` for a unit", digits, name));
    }
    if (error != std::errc{}) refuse_at(begin, text_, fmt::format("`{}` is beyond the range of numbers", digits));
    return {ExpressionToken::Kind::number, {begin, at_}, value};
  }

  ExpressionToken name() {
    const std::size_t begin = at_;
    at_ += name_length(text_.substr(at_));
    return {ExpressionToken::Kind::name, {begin, at_}};
  }

  ExpressionToken sign() {
    const char c = text_[at_];
    const std::size_t begin = at_;
    const std::string_view two = text_.substr(at_, 2);
    for (const std::string_view known : {"<=", ">=", "==", "!=", "&&", "||"})
      if (two == known) {
        at_ += 2;
        return {ExpressionToken::Kind::sign, {begin, at_}};
      }
    if (two == "**") refuse_at(at_, text_, "unexpected `**`", "a power is written with `^`");
    if (c == '=') refuse_at(at_, text_, "an expression cannot assign", "`==` compares");
    if (c == '!') refuse_at(at_, text_, "unexpected `!`", "`!=` compares, `a == 0` negates");
    if (c == '&' || c == '|') refuse_at(at_, text_, fmt::format("unexpected `{}`", c), "`&&` is and, `||` is or");
    depth_ += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth_ > most_parentheses) refuse_at(at_, text_, "parentheses are nested too deeply");
    if (c == ',' && depth_ <= 0) refuse_at(at_, text_, "an expression has one value", "a number has no comma: 1000 or 1.5");
    if (std::string_view("+-*/^(),?:<>").find(c) == std::string_view::npos)
      refuse_at(at_, text_, fmt::format("unexpected `{}` in an expression", c));
    ++at_;
    return {ExpressionToken::Kind::sign, {begin, at_}};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// choice = either [ "?" choice ":" choice ];  either = both { "||" both };  both = comparison { "&&" comparison };
/// comparison = sum { "<" sum };  sum = product { "+" product };  product = signed { "*" signed };
/// signed = [ "-" ] signed | power;  power = value [ "^" signed ];  value = number | name | call | "(" choice ")".
class ExpressionParser {
  using Op = ExpressionCode::Op;
  using Part = ExpressionCode::Part;

 public:
  ExpressionParser(std::string_view text, std::vector<ExpressionToken> tokens) : text_(text), tokens_(std::move(tokens)) {
    find_variables();
  }

  ExpressionCode run() {
    try {
      choice();
      if (!at_end()) unexpected();
    } catch (TextError& error) {
      code_.error = std::move(error);
    }
    return std::move(code_);
  }

 private:
  using Level = Part (ExpressionParser::*)();

  const ExpressionToken& now() const { return tokens_[at_]; }
  bool at_end() const { return now().kind == ExpressionToken::Kind::end; }
  std::string_view text_of(const Part& part) const { return text_.substr(part.begin, part.end - part.begin); }
  bool is_sign(std::size_t at, std::string_view sign) const {
    return tokens_[at].kind == ExpressionToken::Kind::sign && text_of(tokens_[at].part) == sign;
  }
  bool take(std::string_view sign) {
    if (!is_sign(at_, sign)) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void unexpected() const {
    if (at_end()) refuse_at(text_.size(), text_, "the expression ends too early");
    const std::string_view found = text_of(now().part);
    const bool value = now().kind != ExpressionToken::Kind::sign;
    refuse_at(now().part.begin, text_, fmt::format("unexpected `{}`", found),
         value ? fmt::format("is an operator missing before `{}`?", found) : found == ":" ? "a ratio is one number: 5, not 5:1" : "");
  }

  bool is_call(std::size_t at) const { return is_sign(at + 1, "(") && find_function(text_of(tokens_[at].part)); }

  void find_variables() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].kind != ExpressionToken::Kind::name || is_call(i)) continue;
      const std::string_view name = text_of(tokens_[i].part);
      if (variable(name) == code_.variables.size())
        code_.variables.push_back({std::string(name), tokens_[i].part.begin, is_sign(i + 1, "(")});
    }
  }

  std::size_t variable(std::string_view name) const {
    const auto& variables = code_.variables;
    const auto found = std::find_if(variables.begin(), variables.end(), [&](auto& v) { return v.name == name; });
    return static_cast<std::size_t>(found - variables.begin());
  }

  std::size_t emit(ExpressionCode::Instruction instruction) {
    code_.instructions.push_back(instruction);
    return code_.instructions.size() - 1;
  }

  /// Parses operators of equal precedence, which associate to the left.
  template <std::size_t N>
  Part chain(Level level, const std::pair<std::string_view, Op> (&operators)[N]) {
    const Part first = (this->*level)();
    Part whole = first;
    for (bool again = true; again;) {
      again = false;
      for (const auto& [sign, op] : operators) {
        if (!take(sign)) continue;
        const Part right = (this->*level)();
        whole.end = right.end;
        emit({.op = op, .left = first, .right = right, .whole = whole});
        again = true;
        break;
      }
    }
    return whole;
  }

  Part choice() {
    if (++depth_ > most_levels_within) refuse_at(now().part.begin, text_, "the expression is nested too deeply");
    Part whole = either();
    if (take("?")) {
      const std::size_t test = emit({.op = Op::unless_jump});
      const Part yes = choice();
      const std::size_t skip = emit({.op = Op::jump});
      code_.instructions[test].index = code_.instructions.size();
      if (!take(":")) {
        if (at_end())
          refuse_at(text_.size(), text_, "the expression ends too early", "a choice is written `a > b ? x : y`");
        unexpected();
      }
      const Part no = choice();
      code_.instructions[test].left = yes;
      code_.instructions[test].right = no;
      whole.end = no.end;
      code_.instructions[skip].index = code_.instructions.size();
    }
    --depth_;
    return whole;
  }
  Part either() { return chain(&ExpressionParser::both, {std::pair{std::string_view("||"), Op::either}}); }
  Part both() { return chain(&ExpressionParser::comparison, {std::pair{std::string_view("&&"), Op::both}}); }
  Part comparison() {
    using Pair = std::pair<std::string_view, Op>;
    return chain(&ExpressionParser::sum, {Pair{"<=", Op::at_most}, Pair{">=", Op::at_least}, Pair{"==", Op::equal},
                                Pair{"!=", Op::unequal}, Pair{"<", Op::less}, Pair{">", Op::greater}});
  }
  Part sum() {
    using Pair = std::pair<std::string_view, Op>;
    return chain(&ExpressionParser::product, {Pair{"+", Op::plus}, Pair{"-", Op::minus}});
  }
  Part product() {
    using Pair = std::pair<std::string_view, Op>;
    return chain(&ExpressionParser::with_sign, {Pair{"*", Op::times}, Pair{"/", Op::over}});
  }

  Part with_sign() {
    if (++depth_ > most_levels_within) refuse_at(now().part.begin, text_, "the expression is nested too deeply");
    const std::size_t begin = now().part.begin;
    Part whole;
    if (take("-")) {
      whole = {begin, with_sign().end};
      emit({.op = Op::negative, .whole = whole});
    } else if (take("+")) {
      whole = {begin, with_sign().end};
    } else {
      whole = power();
    }
    --depth_;
    return whole;
  }

  Part power() {
    const Part base = value();
    if (!take("^")) return base;
    const Part exponent = with_sign();
    const Part whole{base.begin, exponent.end};
    emit({.op = Op::power, .left = base, .right = exponent, .whole = whole});
    return whole;
  }

  Part value() {
    const ExpressionToken token = now();
    if (token.kind == ExpressionToken::Kind::number) {
      ++at_;
      emit({.op = Op::number, .number = token.number, .whole = token.part});
      return token.part;
    }
    if (token.kind == ExpressionToken::Kind::name) {
      if (is_call(at_)) return call();
      ++at_;
      emit({.op = Op::variable, .index = variable(text_of(token.part)), .whole = token.part});
      return token.part;
    }
    if (!take("(")) unexpected();
    choice();
    return {token.part.begin, close(token.part.begin)};
  }

  std::size_t close(std::size_t open) {
    const std::size_t end = now().part.end;
    if (at_end()) refuse_at(open, text_, "a `)` is missing");
    if (!take(")")) unexpected();
    return end;
  }

  Part call() {
    const Part name = now().part;
    const ExpressionFunction& function = *find_function(text_of(name));
    const std::size_t open = tokens_[++at_].part.begin;
    ++at_;
    std::vector<Part> arguments;
    if (!is_sign(at_, ")")) do
        arguments.push_back(choice());
      while (take(","));
    const std::size_t end = close(open);
    const int count = static_cast<int>(arguments.size());
    const bool too_many = function.most_arguments >= 0 && count > function.most_arguments;
    if (too_many || count < function.least_arguments)
      refuse_at(name.begin, text_, fmt::format("too {} arguments for `{}`", too_many ? "many" : "few", function.name),
           fmt::format("it is called so: `{}({})`", function.name, function.arguments));
    emit({.op = Op::call,
          .index = code_.arguments.size(),
          .count = arguments.size(),
          .function = &function,
          .whole = {name.begin, end}});
    code_.arguments.insert(code_.arguments.end(), arguments.begin(), arguments.end());
    return {name.begin, end};
  }

  std::string_view text_;
  std::vector<ExpressionToken> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  ExpressionCode code_;
};

}  // namespace

ExpressionCode compile_expression(std::string_view text) { return ExpressionParser(text, ExpressionScanner(text).run()).run(); }

}  // namespace rheonet

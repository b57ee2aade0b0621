#include "view/expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/visible_text.h"

namespace talus::view {
namespace {

using Operation = Expression::Operation;

constexpr std::size_t longest_text =
    1000;  // limits the nesting, so that the recursion cannot exhaust the stack

constexpr std::string_view blanks = " \t";
constexpr std::string_view digits = "0123456789";
constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";

/// Number, name or sign in the text.
struct Token {
  enum class Kind { number, name, sign, end };
  Kind kind = Kind::end;
  std::string_view text;
  std::size_t place = 0;  ///< index of its first character
  double number = 0.0;
};

/// Two-character signs precede the one-character signs that they begin with.
constexpr std::array<std::string_view, 15> signs = {"<=", ">=", "==", "!=", "&&", "||", "<", ">",
                                                    "!",  "(",  ")",  "+",  "-",  "*",  "/"};

/// Common misspelling of a sign, with its correction.
struct Slip {
  std::string_view written, meant;
};
constexpr std::array<Slip, 9> slips = {{{"=>", ">="},
                                        {"=<", "<="},
                                        {"<>", "!="},
                                        {"=", "=="},
                                        {"&", "&&"},
                                        {"|", "||"},
                                        {"and", "&&"},
                                        {"or", "||"},
                                        {"not", "!"}}};

constexpr std::array<std::pair<std::string_view, Operation>, 6> comparisons = {{{"<", Operation::less},
                                                                                {"<=", Operation::at_most},
                                                                                {">", Operation::greater},
                                                                                {">=", Operation::at_least},
                                                                                {"==", Operation::equal},
                                                                                {"!=", Operation::unequal}}};

/// Type of a part of the text: a number, a condition, or a flag, which can serve as either.
enum class Value { number, condition, flag };

class Parser {
 public:
  Parser(std::string_view text, std::span<const ExpressionName> names) : text_(text), names_(names) {
    if (text.size() > longest_text)
      fail(longest_text, fmt::format("expected at most {} characters, found {}", longest_text, text.size()));
    advance();
  }

  Expression parse() {
    if (token_.kind == Token::Kind::end) expect("a condition, such as gamma > 0.7");
    const Value value = parse_or();
    if (token_.kind != Token::Kind::end) expect("an operator or the end");
    to_condition(value, 0);
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(std::size_t place, const std::string& what) const {
    throw Error(ExitCode::usage,
                fmt::format("'{}', column {}: {}", visible_word(text_, 200), place + 1, what));
  }

  /// Reports that the token found is not among those that may follow here.
  [[noreturn]] void expect(const std::string& what) const {
    const std::string_view rest = text_.substr(token_.place);
    const auto slip = std::ranges::find_if(slips, [&](const Slip& entry) {
      return letters.find(entry.written[0]) == std::string_view::npos ? rest.starts_with(entry.written)
                                                                      : token_.text == entry.written;
    });
    std::string found = token_.kind == Token::Kind::end ? "the end" : "'" + visible_word(token_.text) + "'";
    std::string hint;
    if (slip != slips.end()) {
      found = fmt::format("'{}'", slip->written);
      hint = fmt::format("; did you mean '{}'?", slip->meant);
    } else if (token_.text == ",") {
      hint = "; write a decimal point, as in 0.7";
    }
    fail(token_.place, fmt::format("expected {}, found {}{}", what, found, hint));
  }

  void advance() {
    const std::size_t place = std::min(text_.find_first_not_of(blanks, end_), text_.size());
    const std::string_view rest = text_.substr(place);
    token_ = {Token::Kind::end, {}, place, 0.0};
    if (rest.empty()) return;
    const bool fraction = rest.size() > 1 && rest[0] == '.' && digits.find(rest[1]) != std::string_view::npos;
    if (fraction || digits.find(rest[0]) != std::string_view::npos) {
      take_number(rest);
    } else if (letters.find(rest[0]) != std::string_view::npos) {
      const auto size = std::ranges::find_if_not(rest,
                                                 [](char c) {
                                                   return letters.find(c) != std::string_view::npos ||
                                                          digits.find(c) != std::string_view::npos;
                                                 }) -
                        rest.begin();
      token_.kind = Token::Kind::name;
      token_.text = rest.substr(0, static_cast<std::size_t>(size));
    } else {
      token_.kind = Token::Kind::sign;
      const auto sign = std::ranges::find_if(
          signs, [&](std::string_view candidate) { return rest.starts_with(candidate); });
      token_.text =
          sign == signs.end() ? rest.substr(0, std::max<std::size_t>(1, character_length(rest))) : *sign;
    }
    end_ = place + token_.text.size();
  }

  void take_number(std::string_view rest) {
    token_.kind = Token::Kind::number;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), token_.number);
    const auto size = static_cast<std::size_t>(end - rest.data());
    token_.text = rest.substr(0, size);
    if (error != std::errc()) fail(token_.place, fmt::format("{} is out of range", token_.text));
    if (size < rest.size() && letters.find(rest[size]) != std::string_view::npos)
      fail(token_.place + size,
           fmt::format("expected an operator or the end after {}, found '{}'; write numbers without units",
                       token_.text, visible_word(rest.substr(size, 1))));
  }

  bool is(std::string_view sign) const { return token_.kind == Token::Kind::sign && token_.text == sign; }
  bool take(std::string_view sign) {
    if (!is(sign)) return false;
    advance();
    return true;
  }
  void add(Operation operation) { result_.steps.push_back({operation, 0.0, 0}); }

  // `place` is the beginning of this part of the text.
  void to_condition(Value value, std::size_t place) const {
    if (value == Value::number)
      fail(begin_of(place), "expected a condition, such as gamma > 0.7, found a number");
  }
  void to_number(Value value, std::size_t place) const {
    if (value == Value::condition) fail(begin_of(place), "expected a number, found a condition");
  }
  std::size_t begin_of(std::size_t place) const {
    return std::min(text_.find_first_not_of(blanks, place), text_.size());
  }

  Value parse_or() {
    const std::size_t first = token_.place;
    Value value = parse_and();
    while (is("||")) {
      to_condition(value, first);
      advance();
      const std::size_t second = token_.place;
      to_condition(parse_and(), second);
      add(Operation::either);
      value = Value::condition;
    }
    return value;
  }

  Value parse_and() {
    const std::size_t first = token_.place;
    Value value = parse_not();
    while (is("&&")) {
      to_condition(value, first);
      advance();
      const std::size_t second = token_.place;
      to_condition(parse_not(), second);
      add(Operation::both);
      value = Value::condition;
    }
    return value;
  }

  Value parse_not() {
    if (!take("!")) return comparison();
    const std::size_t place = token_.place;
    to_condition(parse_not(), place);
    add(Operation::no);
    return Value::condition;
  }

  std::optional<Operation> comparison_sign() const {
    for (const auto& [sign, operation] : comparisons)
      if (is(sign)) return operation;
    return std::nullopt;
  }

  Value comparison() {
    const std::size_t first = token_.place;
    const Value value = sum();
    const auto operation = comparison_sign();
    if (!operation) return value;
    to_number(value, first);
    advance();
    const std::size_t second = token_.place;
    to_number(sum(), second);
    add(*operation);
    if (comparison_sign())
      fail(token_.place,
           fmt::format("expected && or || between two comparisons, found '{}'; write a < b && b "
                       "< c where you mean a < b < c",
                       token_.text));
    return Value::condition;
  }

  /// Parses operands separated by operators of equal precedence, evaluated from left to right.
  template <typename Operand>
  Value chain(std::string_view sign, Operation operation, std::string_view other_sign, Operation other,
              const Operand& operand) {
    const std::size_t first = token_.place;
    Value value = operand();
    while (is(sign) || is(other_sign)) {
      to_number(value, first);
      const Operation then = is(sign) ? operation : other;
      advance();
      const std::size_t second = token_.place;
      to_number(operand(), second);
      add(then);
      value = Value::number;
    }
    return value;
  }

  Value sum() {
    return chain("+", Operation::plus, "-", Operation::minus, [this] { return product(); });
  }
  Value product() {
    return chain("*", Operation::times, "/", Operation::over, [this] { return factor(); });
  }

  Value factor() {
    if (take("-")) {
      const std::size_t place = token_.place;
      to_number(factor(), place);
      add(Operation::negative);
      return Value::number;
    }
    if (take("(")) return in_parentheses();
    if (token_.kind == Token::Kind::number) {
      result_.steps.push_back({Operation::number, token_.number, 0});
      advance();
      return Value::number;
    }
    if (token_.kind == Token::Kind::name && token_.text != "not") return name();
    expect("a number, a name or (");
  }

  Value in_parentheses() {
    const Value value = parse_or();
    if (!take(")")) expect("an operator or )");
    return value;
  }

  Value name() {
    const Token token = token_;
    advance();
    if (take("(")) return function(token);
    const auto known = std::ranges::find(names_, token.text, &ExpressionName::name);
    if (known == names_.end())
      fail(token.place, fmt::format("{} is not a quantity of a grain{}", visible_word(token.text),
                                    did_you_mean(token.text, names_of(names_))));
    auto used = std::ranges::find(result_.names, token.text);
    if (used == result_.names.end()) used = result_.names.insert(used, std::string(token.text));
    result_.steps.push_back({Operation::name, 0.0, static_cast<std::size_t>(used - result_.names.begin())});
    return known->flag ? Value::flag : Value::number;
  }

  Value function(const Token& token) {
    if (token.text != "abs" && token.text != "sqrt")
      fail(token.place, fmt::format("{} is not a function; use abs or sqrt", visible_word(token.text)));
    const std::size_t place = token_.place;
    to_number(in_parentheses(), place);
    add(token.text == "abs" ? Operation::absolute : Operation::root);
    return Value::number;
  }

  std::string_view text_;
  std::span<const ExpressionName> names_;
  Token token_;
  std::size_t end_ = 0;  ///< end of the current token
  Expression result_;
};

double result_of(Operation operation, double a, double b) {
  switch (operation) {
    case Operation::plus:
      return a + b;
    case Operation::minus:
      return a - b;
    case Operation::times:
      return a * b;
    case Operation::over:
      return a / b;
    case Operation::less:
      return a < b;
    case Operation::at_most:
      return a <= b;
    case Operation::greater:
      return a > b;
    case Operation::at_least:
      return a >= b;
    case Operation::equal:
      return a == b;
    case Operation::unequal:
      return a < b || a > b;
    case Operation::both:
      return a != 0.0 && b != 0.0;
    case Operation::either:
      return a != 0.0 || b != 0.0;
    default:
      return 0.0;
  }
}

}  // namespace

Expression parse_condition(std::string_view text, std::span<const ExpressionName> names) {
  return Parser(text, names).parse();
}

bool holds(const Expression& condition, std::span<const double> values) {
  std::vector<double> stack;
  for (const Expression::Step& step : condition.steps) {
    switch (step.operation) {
      case Operation::number:
        stack.push_back(step.number);
        break;
      case Operation::name:
        stack.push_back(values[step.name]);
        break;
      case Operation::negative:
        stack.back() = -stack.back();
        break;
      case Operation::absolute:
        stack.back() = std::abs(stack.back());
        break;
      case Operation::root:
        stack.back() = std::sqrt(stack.back());
        break;
      case Operation::no:
        stack.back() = stack.back() == 0.0;
        break;
      default: {
        const double b = stack.back();
        stack.pop_back();
        stack.back() = result_of(step.operation, stack.back(), b);
      }
    }
  }
  return stack.back() != 0.0;
}

}  // namespace talus::view

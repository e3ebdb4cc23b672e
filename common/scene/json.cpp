#include "common/scene/json.h"

#include <fmt/format.h>
#include <rapidjson/reader.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "common/error.h"

namespace airlight::json {

namespace {

constexpr std::size_t deepest = 64;
constexpr std::size_t most_members = 1000;  // of an object: the search for duplicates is quadratic

// Turns byte offsets into places. Asked in rising order it reads the text once.
class Places {
 public:
  Places(std::string_view text, int line) : text_(text), line_(line), place_{line, 1} {}

  Place at(std::size_t offset) {
    offset = std::min(offset, text_.size());
    if (offset < offset_) offset_ = 0, place_ = {line_, 1};
    for (; offset_ < offset; ++offset_) {
      const auto byte = static_cast<std::uint8_t>(text_[offset_]);
      if (byte == '\n') {
        ++place_.line;
        place_.column = 1;
      } else if ((byte & 0xC0U) != 0x80U) {  // not the continuation of a character
        ++place_.column;
      }
    }
    // An offset inside a character belongs to that character.
    if (offset < text_.size() && (static_cast<std::uint8_t>(text_[offset]) & 0xC0U) == 0x80U && place_.column > 1) {
      return {place_.line, place_.column - 1};
    }
    return place_;
  }

 private:
  std::string_view text_;
  int line_;
  std::size_t offset_ = 0;
  Place place_;
};

// The reader would advance a copy of a plain InsituStringStream while it reads a token; of this one it keeps none, so
// that Tell() is exact.
struct Stream : rapidjson::InsituStringStream {
  explicit Stream(char* text) : GenericInsituStringStream(text) {}
};

// Receives RapidJSON's events. The text is parsed in place, so that a string's address tells where it begins; every
// other token's begin is the reader's position less the token's length.
class Builder {
 public:
  using Ch = char;

  Builder(std::string_view original, Stream& stream, const std::string& name, int line)
      : places_(original, line), original_(original), stream_(stream), name_(name) {}

  bool Null() { return add(Kind::null, stream_.Tell() - 4), true; }
  bool Bool(bool b) {
    add(Kind::boolean, stream_.Tell() - (b ? 4 : 5)).boolean = b;
    return true;
  }
  bool RawNumber(const char*, rapidjson::SizeType length, bool) {
    const std::size_t begin = stream_.Tell() - length;
    Value& v = add(Kind::number, begin);
    v.text = original_.substr(begin, length);  // std::from_chars does not look at the locale
    const auto [end, error] = std::from_chars(v.text.data(), v.text.data() + v.text.size(), v.number);
    if (error != std::errc() || end != v.text.data() + v.text.size()) {
      throw InputError(message(name_, v.place, quoted(v.text) + " is not representable, expected a finite number"));
    }
    return true;
  }
  bool String(const char* text, rapidjson::SizeType length, bool) {
    add(Kind::string, offset_of(text) - 1).text.assign(text, length);
    return true;
  }
  bool Key(const char* text, rapidjson::SizeType length, bool) {
    key_.assign(text, length);
    key_place_ = places_.at(offset_of(text) - 1);
    if (open_.back()->items.size() == most_members) {
      throw InputError(message(name_, key_place_, fmt::format("an object of more than {} keys, expected fewer", most_members)));
    }
    for (const Value& other : open_.back()->items) {
      if (other.key != key_) continue;
      throw InputError(
          message(name_, key_place_,
                  fmt::format("duplicate key {}, expected it once (it is also in line {})", quoted(key_), other.key_place.line)));
    }
    return true;
  }
  bool StartObject() { return start(Kind::object); }
  bool StartArray() { return start(Kind::array); }
  bool EndObject(rapidjson::SizeType) { return open_.pop_back(), true; }
  bool EndArray(rapidjson::SizeType) { return open_.pop_back(), true; }
  // Numbers come as RawNumber; the reader still names these.
  bool Int(int) { return false; }
  bool Uint(unsigned) { return false; }
  bool Int64(std::int64_t) { return false; }
  bool Uint64(std::uint64_t) { return false; }
  bool Double(double) { return false; }

  Value root;

 private:
  std::size_t offset_of(const char* p) const { return static_cast<std::size_t>(p - stream_.head_); }

  Value& add(Kind kind, std::size_t begin) {
    Value* v = &root;
    if (!open_.empty()) {
      v = &open_.back()->items.emplace_back();
      if (open_.back()->kind == Kind::object) {
        v->key = key_;
        v->key_place = key_place_;
      }
    }
    v->kind = kind;
    v->place = places_.at(begin);
    return *v;
  }

  // A vector of values does not move while one of its elements is open: elements are only added to the innermost one.
  bool start(Kind kind) {
    Value& v = add(kind, stream_.Tell() - 1);
    if (open_.size() == deepest) {
      throw InputError(message(name_, v.place, fmt::format("nested deeper than {} levels, expected fewer", deepest)));
    }
    open_.push_back(&v);
    return true;
  }

  Places places_;
  std::string_view original_;
  Stream& stream_;
  const std::string& name_;
  std::vector<Value*> open_;
  std::string key_;
  Place key_place_;
};

std::string_view explained(rapidjson::ParseErrorCode code) {
  switch (code) {
    case rapidjson::kParseErrorDocumentEmpty:
      return "empty, expected a JSON object";
    case rapidjson::kParseErrorDocumentRootNotSingular:
      return "unexpected text, expected the end of the file";
    case rapidjson::kParseErrorValueInvalid:
      return "invalid value, expected an object, an array, a string in double quotes, a finite number, true, false or "
             "null";
    case rapidjson::kParseErrorObjectMissName:
      return "invalid object, expected a key in double quotes";
    case rapidjson::kParseErrorObjectMissColon:
      return "missing colon, expected ':' after the key";
    case rapidjson::kParseErrorObjectMissCommaOrCurlyBracket:
      return "unfinished object, expected ',' or '}'";
    case rapidjson::kParseErrorArrayMissCommaOrSquareBracket:
      return "unfinished array, expected ',' or ']'";
    case rapidjson::kParseErrorStringUnicodeEscapeInvalidHex:
      return "invalid escape, expected four hexadecimal digits after \\u";
    case rapidjson::kParseErrorStringUnicodeSurrogateInvalid:
      return "invalid escape, expected a pair of surrogates";
    case rapidjson::kParseErrorStringEscapeInvalid:
      return "invalid escape in a string, expected one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u";
    case rapidjson::kParseErrorStringMissQuotationMark:
      return "unterminated string, expected '\"'";
    case rapidjson::kParseErrorStringInvalidEncoding:
      return "invalid text in a string, expected UTF-8 without control characters";
    case rapidjson::kParseErrorNumberTooBig:
      return "number too big, expected a finite number";
    case rapidjson::kParseErrorNumberMissFraction:
      return "invalid number, expected a digit after the decimal point";
    case rapidjson::kParseErrorNumberMissExponent:
      return "invalid number, expected a digit in the exponent";
    default:
      return "syntax error, expected JSON (an unfinished comment?)";
  }
}

}  // namespace

std::string message(const std::string& name, Place place, std::string_view what) {
  return fmt::format("{}:{}:{}: {}", name, place.line, place.column, what);
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::size_t length = std::min(text.size(), longest);
  while (length < text.size() && length > 0 && (static_cast<std::uint8_t>(text[length]) & 0xC0U) == 0x80U) --length;
  std::string out = "\"";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<std::uint8_t>(c);
    if (byte < 0x20 || byte == 0x7F) {
      out += fmt::format("\\u{:04x}", byte);
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + (length < text.size() ? "...\"" : "\"");
}

Value parse(std::string_view text, const std::string& name, int line) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") {
    throw InputError(message(name, {line, 1}, "a UTF-8 byte order mark, expected the text to begin at once"));
  }
  if (const std::size_t zero = text.find('\0'); zero != text.npos) {
    throw InputError(message(name, Places(text, line).at(zero), "a zero byte, expected UTF-8 text"));
  }
  std::string buffer(text);  // parsing in place changes it
  Stream stream(buffer.data());
  Builder builder(text, stream, name, line);
  rapidjson::Reader reader;
  constexpr unsigned flags = rapidjson::kParseInsituFlag | rapidjson::kParseCommentsFlag | rapidjson::kParseNumbersAsStringsFlag |
                             rapidjson::kParseValidateEncodingFlag;
  if (!reader.Parse<flags>(stream, builder)) {
    // The reader stops inside a misspelt word; the place is its first letter.
    std::size_t at = reader.GetErrorOffset();
    const auto of_word = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '+'; };
    if (reader.GetParseErrorCode() == rapidjson::kParseErrorValueInvalid) {
      while (at > 0 && of_word(text[at - 1])) --at;
    }
    const bool line_end = reader.GetParseErrorCode() == rapidjson::kParseErrorStringEscapeInvalid && text[at] != '\\';
    throw InputError(message(name, Places(text, line).at(at),
                             line_end ? "a line end or control character in a string, expected '\"' before it"
                                      : explained(reader.GetParseErrorCode())));
  }
  return std::move(builder.root);
}

}  // namespace airlight::json

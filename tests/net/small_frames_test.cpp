#include "net/small_frames.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "net/admission.h"

// What small frames carry whole, what they refuse, and whom a server lets in by them.

namespace myotact::net {
namespace {

Bytes payload_bytes(const SmallFrame& frame) {
  return {frame.payload().begin(), frame.payload().end()};
}

/// Whether a payload is still taken with that byte in that place, which the format's description tells.
template <typename Message>
bool takes(const Message& message, std::size_t place, int byte) {
  Bytes payload = payload_bytes(encode(message));
  payload.at(place) = static_cast<std::uint8_t>(byte);
  Message read;
  return decode(payload, read);
}

std::string read_back(const Bye& bye) {
  Bye read;
  EXPECT_TRUE(decode(encode(bye).payload(), read)) << bye.text;
  return read.text;
}

std::string read_back(const Event& event) {
  Event read;
  EXPECT_TRUE(decode(encode(event).payload(), read)) << event.text;
  return read.text;
}

std::string read_back(const Hello& hello) {
  Hello read;
  EXPECT_TRUE(decode(encode(hello).payload(), read)) << hello.name;
  return read.name;
}

Hello named(const std::string& name) {
  Hello hello;
  hello.name = name;
  return hello;
}

TEST(SmallFrames, CutLongTextsBetweenTwoCharacters) {
  const std::string whole(96, 'a');
  EXPECT_EQ(read_back(Bye{ByeReason::Full, whole}), whole);
  EXPECT_EQ(read_back(Bye{ByeReason::Full, whole + "b"}), whole);
  for (const std::string character : {"ü", "前", "🐕"}) {  // 2, 3 and 4 bytes
    for (std::size_t before = 96 - character.size() + 1; before < 96; ++before) {
      const std::string begin(before, 'a');
      EXPECT_EQ(read_back(Bye{ByeReason::Full, begin + character}), begin) << before;
      EXPECT_EQ(read_back(Event{EventCode::Refused, 0, begin + character + "c"}), begin) << before;
    }
    const std::string fits = std::string(96 - character.size(), 'a') + character;
    EXPECT_EQ(read_back(Bye{ByeReason::Full, fits + "d"}), fits);
    const std::string begin(47, 'n');
    EXPECT_EQ(read_back(named(begin + character)), begin) << "a name has 48 bytes";
  }
}

template <typename Message>
void expect_that_length_alone(const Message& message) {
  Bytes payload = payload_bytes(encode(message));
  Message read;
  EXPECT_TRUE(decode(payload, read));
  for (std::size_t size = 0; size < payload.size(); ++size) {
    EXPECT_FALSE(decode(std::span(payload).first(size), read)) << size << " of " << payload.size();
  }
  payload.push_back(0);
  EXPECT_FALSE(decode(payload, read)) << "a byte too many";
}

TEST(SmallFrames, OfAnotherLengthAreRefused) {
  expect_that_length_alone(Hello{});
  expect_that_length_alone(Welcome{});
  expect_that_length_alone(ForceAnswer{});
  expect_that_length_alone(Event{});
  expect_that_length_alone(Ping{});
  expect_that_length_alone(Pong{});
  expect_that_length_alone(Bye{});
}

TEST(SmallFrames, ValuesBeyondTheirRangeAreRefused) {
  EXPECT_TRUE(takes(Hello{}, 2, 2) && takes(Hello{}, 3, 127) && takes(Hello{}, 4, 2));
  EXPECT_FALSE(takes(Hello{}, 2, 3)) << "role";
  EXPECT_FALSE(takes(Hello{}, 3, 128)) << "a want that nobody knows";
  EXPECT_FALSE(takes(Hello{}, 4, 3)) << "hand";
  EXPECT_TRUE(takes(Welcome{}, 12, 0xFF) && takes(Welcome{}, 12, 1) && takes(Welcome{}, 14, 1));
  EXPECT_FALSE(takes(Welcome{}, 12, 0xFE)) << "hand -2";
  EXPECT_FALSE(takes(Welcome{}, 13, 3)) << "role";
  EXPECT_FALSE(takes(Welcome{}, 14, 2)) << "lockstep";
  EXPECT_FALSE(takes(Event{}, 0, 0)) << "code";
  EXPECT_FALSE(takes(Event{}, 0, 3)) << "code";
  EXPECT_TRUE(takes(Bye{}, 0, 7));
  EXPECT_FALSE(takes(Bye{}, 0, 8)) << "reason";
  EXPECT_FALSE(takes(named("n"), 29, 0)) << "a name with the byte 0";
  EXPECT_FALSE(takes(named("n"), 29, 0xC3)) << "a name that is not UTF-8";
  Bytes long_name = payload_bytes(encode(named(std::string(48, 'n'))));
  long_name.push_back('n');
  Hello read;
  EXPECT_FALSE(decode(long_name, read));
}

TEST(SmallFrames, AForceThatIsNoNumberIsRefused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ForceAnswer force{7, 8, {1.0, 2.0, 3.0}};
      force.force_world_N[axis] = bad;
      ForceAnswer read;
      EXPECT_FALSE(decode(encode(force).payload(), read)) << axis;
    }
  }
}

Token token_of(std::uint8_t first) {
  Token token{};
  for (std::uint8_t& byte : token) byte = first++;
  return token;
}

const Token kClassToken = token_of(0x10), kTeacherToken = token_of(0x70), kWrongToken = token_of(0xA0);

/// What is said to somebody who comes with that; nothing: come in.
std::optional<Bye> knock(const AccessPolicy& rules, Role role, const Token& token, std::uint16_t version = 1) {
  Hello hello;
  hello.version = version;
  hello.role = role;
  hello.token = token;
  const SmallFrame frame = encode(hello);
  Frame first;
  first.header.type = frame.type;
  first.payload = frame.payload();
  Hello read;
  return refusal_of(first, rules, read);
}

TEST(Admission, WithoutTokensEverybodyMayComeAndLead) {
  for (const Role role : {Role::Viewer, Role::Student, Role::Instructor}) EXPECT_FALSE(knock({}, role, kWrongToken));
}

TEST(Admission, ATokenLetsInAndOneBitOfItWrongDoesNot) {
  const AccessPolicy rules{kClassToken, {}};
  for (const Role role : {Role::Viewer, Role::Student, Role::Instructor}) {
    EXPECT_FALSE(knock(rules, role, kClassToken)) << "without a token of their own instructors come with this one";
    EXPECT_EQ(knock(rules, role, {})->reason, ByeReason::Token);
  }
  for (std::size_t bit = 0; bit < 128; ++bit) {
    Token wrong = kClassToken;
    wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ (1u << bit % 8));
    const auto refused = knock(rules, Role::Student, wrong);
    ASSERT_TRUE(refused) << "bit " << bit;
    EXPECT_EQ(refused->reason, ByeReason::Token);
  }
}

TEST(Admission, OnlyTheInstructorsTokenMakesAnInstructor) {
  for (const AccessPolicy& rules : {AccessPolicy{kClassToken, kTeacherToken}, AccessPolicy{{}, kTeacherToken}}) {
    EXPECT_FALSE(knock(rules, Role::Instructor, kTeacherToken));
    EXPECT_FALSE(knock(rules, Role::Student, kTeacherToken));
    EXPECT_FALSE(knock(rules, Role::Student, kClassToken));
    EXPECT_EQ(knock(rules, Role::Instructor, kClassToken)->reason, ByeReason::Token);
    EXPECT_EQ(knock(rules, Role::Instructor, kWrongToken)->reason, ByeReason::Token);
    EXPECT_EQ(knock(rules, Role::Viewer, kWrongToken).has_value(), rules.token.has_value());
  }
}

TEST(Admission, AnotherVersionIsToldBeforeAWrongToken) {
  const AccessPolicy rules{kClassToken, kTeacherToken};
  for (const auto version : std::initializer_list<std::uint16_t>{0, 2, 0x0101}) {
    const auto refused = knock(rules, Role::Student, kWrongToken, version);
    ASSERT_TRUE(refused) << version;
    EXPECT_EQ(refused->reason, ByeReason::Version);
    EXPECT_NE(refused->text.find("version 1 "), std::string::npos) << refused->text;
  }
}

TEST(Admission, WhatIsNoHelloIsABadFrame) {
  const SmallFrame hello = encode(Hello{});
  Frame first;
  Hello read;
  first.payload = hello.payload();
  for (const FrameType other : {FrameType::Welcome, FrameType::ToolState, FrameType::Control, FrameType::Bye}) {
    first.header.type = other;
    EXPECT_EQ(refusal_of(first, {}, read)->reason, ByeReason::BadFrame);
  }
  first.header.type = FrameType::Hello;
  first.payload = hello.payload().first(28);
  EXPECT_EQ(refusal_of(first, {}, read)->reason, ByeReason::BadFrame);
}

TEST(Admission, EveryReasonReachesThePersonWhole) {
  const AccessPolicy rules{kClassToken, kTeacherToken};
  Hello unread;
  for (const auto& refused : {knock(rules, Role::Student, kWrongToken), knock(rules, Role::Instructor, kClassToken),
                              knock(rules, Role::Student, kClassToken, 2), refusal_of(Frame{}, rules, unread)}) {
    ASSERT_TRUE(refused);
    EXPECT_EQ(read_back(*refused), refused->text);
  }
}

}  // namespace
}  // namespace myotact::net

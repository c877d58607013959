#include "signweave/drawing/contact_sheet.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <pugixml.hpp>
#include <set>
#include <string>

#include "signweave/core/error.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Vector3f;
using testing::HasSubstr;
using testing::Not;

/// A body of few bones: a trunk, a head with eyes, two arms with one finger each, one leg per side.
std::shared_ptr<const Skeleton> body() {
  std::vector<Joint> joints = {{"Hips", kNoJoint, {0, 1, 0}, true},
                               {"Spine", 0, {0, 0.4f, 0}, false},
                               {"Head", 1, {0, 0.1f, 0}, false},
                               {"LeftEye", 2, {0.03f, 0.1f, 0.1f}, false},
                               {"RightEye", 2, {-0.03f, 0.1f, 0.1f}, false}};
  std::vector<Tip> tips = {{2, {0, 0.2f, 0}}, {3, {0, 0, 0.01f}}, {4, {0, 0, 0.01f}}};
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    const auto first = static_cast<JointIndex>(joints.size());
    joints.push_back({name + "Arm", 1, {0.2f * side, 0, 0}, false});
    joints.push_back({name + "ForeArm", first, {0.3f * side, 0, 0}, false});
    joints.push_back({name + "Hand", first + 1, {0.25f * side, 0, 0}, false});
    joints.push_back({name + "HandIndex1", first + 2, {0.1f * side, 0, 0}, false});
    tips.push_back({first + 3, {0.07f * side, 0, 0}});
  }
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    const auto first = static_cast<JointIndex>(joints.size());
    joints.push_back({name + "UpLeg", 0, {0.1f * side, 0, 0}, false});
    joints.push_back({name + "Foot", first, {0, -0.9f, 0}, false});
    tips.push_back({first + 1, {0, 0, 0.2f}});
  }
  return std::make_shared<const Skeleton>(std::move(joints), std::move(tips));
}

Motion standing(std::int64_t frames) {
  return Motion(body(), {100, 1}, frames);
}

pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(svg.data(), svg.size());
  EXPECT_TRUE(result) << result.description();
  return document;
}

std::vector<pugi::xml_node> cells(const pugi::xml_document& document) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xml_node cell : document.child("svg").children("g")) found.push_back(cell);
  return found;
}

TEST(ContactSheet, HasACellForEveryRequestedFrameWithItsCaption) {
  ContactSheetOptions options;
  options.frames = {3, 1, 1};
  options.captions = {"PLUIE", "MATIN"};
  options.title = "meteo";
  options.note = "placeholder shapes, not LSF";
  const std::string svg = contact_sheet(standing(10), options);
  const pugi::xml_document document = parsed(svg);
  const std::vector<pugi::xml_node> found = cells(document);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_STREQ(found[0].child_value("text"), "PLUIE");
  EXPECT_STREQ(found[1].child_value("text"), "MATIN");
  EXPECT_STREQ(found[2].child_value("text"), "0.01 s");  // no caption left: the time
  EXPECT_THAT(svg, HasSubstr(">meteo</text>"));
  EXPECT_THAT(svg, HasSubstr(">placeholder shapes, not LSF</text>"));
}

TEST(ContactSheet, SpreadsItsCellsFromTheFirstFrameToTheLast) {
  ContactSheetOptions options;
  options.cells = 5;
  const pugi::xml_document document = parsed(contact_sheet(standing(201), options));
  std::vector<std::string> captions;
  for (const pugi::xml_node& cell : cells(document)) captions.emplace_back(cell.child_value("text"));
  EXPECT_THAT(captions, testing::ElementsAre("0.00 s", "0.50 s", "1.00 s", "1.50 s", "2.00 s"));
  EXPECT_EQ(cells(parsed(contact_sheet(standing(1000)))).size(), 24U);
  EXPECT_EQ(cells(parsed(contact_sheet(standing(3)))).size(), 3U);  // no more cells than frames
}

TEST(ContactSheet, KeepsTheMostImportantOfTooManyAndSaysSo) {
  ContactSheetOptions options;
  options.most_cells = 96;
  options.note = "placeholder";
  for (std::int64_t i = 0; i < 116; ++i) {
    const bool junction = i % 9 == 4;
    options.frames.push_back(i);
    options.captions.push_back(junction ? fmt::format("J{}", i) : fmt::format("{}", i));
    options.importance.push_back(junction ? 1 : 0);
  }
  const std::string svg = contact_sheet(standing(200), options);
  const pugi::xml_document document = parsed(svg);
  std::vector<int> order;
  int junctions = 0;
  for (const pugi::xml_node& cell : cells(document)) {
    const std::string caption = cell.child_value("text");
    junctions += caption.front() == 'J' ? 1 : 0;
    order.push_back(std::stoi(caption.substr(caption.front() == 'J' ? 1 : 0)));
  }
  ASSERT_EQ(order.size(), 96U);
  EXPECT_EQ(junctions, 13);
  EXPECT_EQ(order.front(), 0);
  EXPECT_EQ(order.back(), 115);
  for (std::size_t i = 1; i < order.size(); ++i) {
    EXPECT_GT(order[i], order[i - 1]);
    EXPECT_LE(order[i], order[i - 1] + 2);  // evenly
  }
  EXPECT_THAT(svg, HasSubstr(">placeholder; 96 of 116 frames shown</text>"));
  options.most_cells = 0;
  EXPECT_EQ(cells(parsed(contact_sheet(standing(200), options))).size(), 116U);
  options.most_cells = 116;
  EXPECT_THAT(contact_sheet(standing(200), options), Not(HasSubstr("frames shown")));
}

TEST(ContactSheet, MakesItsTextsFit) {
  ContactSheetOptions options;
  options.captions = {"SOLEIL → PLUIE", "SOLEIL-BRILLER → CE-SERA-LE-MOMENT", "UN-MOT-QUI-NE-FINIT-PAS-ENCORE-ICI"};
  options.title = "a title that is too long for a sheet of so few columns as this one has, and would be cut off there";
  options.columns = 3;
  const pugi::xml_document document = parsed(contact_sheet(standing(3), options));
  const auto size = [](const pugi::xml_node& text) { return text.attribute("font-size").as_double(); };
  const auto width = [&](const pugi::xml_node& text) {  // for ASCII, with wide capitals
    return 0.6 * size(text) * static_cast<double>(std::string(text.child_value()).size());
  };
  EXPECT_LT(width(document.child("svg").child("text")), 3 * 190);
  EXPECT_LT(size(document.child("svg").child("text")), 16);
  const std::vector<pugi::xml_node> found = cells(document);
  EXPECT_STREQ(found[0].child_value("text"), "SOLEIL → PLUIE");
  EXPECT_EQ(size(found[0].child("text")), 11);
  const pugi::xml_node first = found[1].child("text");
  EXPECT_STREQ(first.child_value(), "SOLEIL-BRILLER →");
  EXPECT_STREQ(first.next_sibling("text").child_value(), "CE-SERA-LE-MOMENT");
  EXPECT_LT(first.attribute("y").as_double() + 10, first.next_sibling("text").attribute("y").as_double());
  EXPECT_LT(size(found[2].child("text")), 11);
  EXPECT_LT(width(found[2].child("text")), 190 - 8);
  options.captions[2] = std::string(400, 'W');
  EXPECT_THAT(contact_sheet(standing(3), options), HasSubstr("textLength=\"174.0\""));
}

TEST(ContactSheet, DrawsTheUpperBodyAndDistinguishesRightFromLeft) {
  const pugi::xml_document document = parsed(contact_sheet(standing(1)));
  int lines = 0;
  std::set<std::string> left, right;
  double lowest = 0;
  for (const pugi::xml_node line : cells(document)[0].children("line")) {
    ++lines;
    const double x = line.attribute("x2").as_double();
    lowest = std::max(lowest, line.attribute("y2").as_double());
    // The viewer faces the signer, whose left is therefore on the right of the picture.
    if (x > 96) left.insert(line.attribute("stroke").value());
    if (x < 94) right.insert(line.attribute("stroke").value());
  }
  EXPECT_EQ(lines, 12);        // trunk, neck, and per side upper arm, forearm, hand, finger, tip; no legs
  ASSERT_EQ(left.size(), 2U);  // arm and hand
  ASSERT_EQ(right.size(), 2U);
  const auto red = [](const std::string& colour) { return std::stoi(colour.substr(1, 2), nullptr, 16); };
  const auto blue = [](const std::string& colour) { return std::stoi(colour.substr(5, 2), nullptr, 16); };
  for (const std::string& colour : left) EXPECT_GT(red(colour), blue(colour)) << colour;
  for (const std::string& colour : right) EXPECT_GT(blue(colour), red(colour)) << colour;
  EXPECT_LT(lowest, 190);
  int heads = 0;
  for ([[maybe_unused]] const pugi::xml_node& head : cells(document)[0].children("ellipse")) ++heads;
  EXPECT_EQ(heads, 1);
}

TEST(ContactSheet, KeepsEveryHandInsideItsCell) {
  Motion motion = standing(3);
  const auto turn = [&](std::int64_t frame, const char* joint, float angle) {
    motion.pose(frame).rotations[static_cast<std::size_t>(motion.skeleton().find(joint).value())] =
        AngleAxisf(angle, Vector3f::UnitZ());
  };
  turn(1, "LeftArm", std::numbers::pi_v<float> / 2);   // straight up
  turn(2, "RightArm", std::numbers::pi_v<float> / 2);  // hanging, the fingertip below the hips
  const pugi::xml_document document = parsed(contact_sheet(motion));
  for (const pugi::xml_node& cell : cells(document)) {
    for (const pugi::xml_node line : cell.children("line")) {
      for (const char* x : {"x1", "x2"}) {
        EXPECT_GE(line.attribute(x).as_double(), 2);
        EXPECT_LE(line.attribute(x).as_double(), 188);
      }
      for (const char* y : {"y1", "y2"}) {
        EXPECT_GE(line.attribute(y).as_double(), 2);
        EXPECT_LE(line.attribute(y).as_double(), 186);
      }
    }
  }
}

TEST(ContactSheet, IsIndependentOfTheSignersPositionAndDirection) {
  const Motion motion = standing(1);
  Motion turned = standing(1);
  turned.pose(0).translations[0] = {4, 1, -3};
  turned.pose(0).rotations[0] = AngleAxisf(std::numbers::pi_v<float> / 2, Vector3f::UnitY());
  EXPECT_EQ(contact_sheet(motion), contact_sheet(turned));
}

TEST(ContactSheet, ShowsTheFaceOfTheTracks) {
  Motion motion = standing(4);
  motion.add_track({"jawOpen", {0, 1, 0, 0}});
  motion.add_track({"eyeBlinkLeft", {0, 0, 1, 0}});
  motion.add_track({"browDownRight", {0, 0, 0, 1}});
  motion.add_track({"noSuchShape", {1, 1, 1, 1}});
  ContactSheetOptions options;
  options.captions = {"", "", "", ""};
  const pugi::xml_document document = parsed(contact_sheet(motion, options));
  std::set<std::string> faces;
  std::vector<std::ptrdiff_t> pupils;
  for (const pugi::xml_node& cell : cells(document)) {
    std::string face;
    for (const pugi::xml_node path : cell.children("path")) face += path.attribute("d").value();
    faces.insert(face);
    const auto circles = cell.children("circle");
    pupils.push_back(std::distance(circles.begin(), circles.end()));
  }
  EXPECT_EQ(faces.size(), 4U);
  EXPECT_THAT(pupils, testing::ElementsAre(2, 2, 1, 2));  // a closed eye has no pupil
}

TEST(ContactSheet, TurnsItsFiguresOnRequest) {
  const auto extent = [](double turn) {
    ContactSheetOptions options;
    options.turn = turn;
    const pugi::xml_document document = parsed(contact_sheet(standing(1), options));
    double least = 1000;
    double most = 0;
    for (const pugi::xml_node line : cells(document)[0].children("line")) {
      for (const char* x : {"x1", "x2"}) {
        least = std::min(least, line.attribute(x).as_double());
        most = std::max(most, line.attribute(x).as_double());
      }
    }
    return most - least;
  };
  EXPECT_GT(extent(0), 150);  // arms held out to the sides
  EXPECT_LT(extent(90), 2);
  EXPECT_NEAR(extent(180), extent(0), 0.2);
}

TEST(ContactSheet, EscapesEveryTextOfAnyScript) {
  ContactSheetOptions options;
  options.captions = {"<A & \"B\">"};
  options.title = "手話 · إشارة";
  options.note = std::string("bad \xff byte, tab\there, bell\x07");
  const std::string svg = contact_sheet(standing(1), options);
  const pugi::xml_document document = parsed(svg);
  EXPECT_STREQ(cells(document)[0].child_value("text"), "<A & \"B\">");
  EXPECT_THAT(svg, HasSubstr("手話 · إشارة"));
  EXPECT_THAT(svg, Not(HasSubstr("\xff")));
  EXPECT_THAT(svg, Not(HasSubstr("\x07")));
}

TEST(ContactSheet, HasTheSameBytesForTheSameMotionAndNumbersOfOnePlace) {
  const std::string svg = contact_sheet(standing(30));
  EXPECT_EQ(svg, contact_sheet(standing(30)));
  const pugi::xml_document document = parsed(svg);
  std::size_t numbers = 0;
  for (const pugi::xml_node& cell : cells(document)) {
    for (const pugi::xml_node line : cell.children("line")) {
      for (const char* name : {"x1", "y1", "x2", "y2"}) {
        const std::string value = line.attribute(name).value();
        EXPECT_EQ(value.find('.'), value.size() - 2) << value;
        EXPECT_EQ(value.find_first_not_of("0123456789."), std::string::npos) << value;
        ++numbers;
      }
    }
  }
  EXPECT_EQ(numbers, 24U * 12 * 4);
}

TEST(ContactSheet, DrawsASkeletonWithMeaninglessNames) {
  const auto plain = std::make_shared<const Skeleton>(
      std::vector<Joint>{
          {"a", kNoJoint, {0, 1, 0}, true}, {"b", 0, {0, 0.5f, 0}, false}, {"c", 1, {0.5f, 0, 0}, false}},
      std::vector<Tip>{{2, {0.1f, 0, 0}}});
  EXPECT_EQ(cells(parsed(contact_sheet(Motion(plain, {30, 1}, 2)))).size(), 2U);
  const auto point =
      std::make_shared<const Skeleton>(std::vector<Joint>{{"a", kNoJoint, {0, 1, 0}, true}}, std::vector<Tip>{});
  EXPECT_EQ(cells(parsed(contact_sheet(Motion(point, {30, 1}, 1)))).size(), 1U);
}

/// The body with its joints changed; tips stay.
Motion changed(const std::function<void(Joint&)>& change, std::int64_t frames = 1) {
  const auto straight = body();
  std::vector<Joint> joints(straight->joints().begin(), straight->joints().end());
  for (Joint& joint : joints) change(joint);
  return Motion(
      std::make_shared<const Skeleton>(joints, std::vector<Tip>(straight->tips().begin(), straight->tips().end())),
      {100, 1}, frames);
}

TEST(ContactSheet, DrawsTheSameTrunkIfTheRootIsOnTheGround) {
  const auto straight = body();
  std::vector<Joint> joints = {{"Scene", kNoJoint, {0, 0, 0}, true}};
  for (Joint joint : straight->joints()) {
    ++joint.parent;
    joints.push_back(std::move(joint));
  }
  std::vector<Tip> tips(straight->tips().begin(), straight->tips().end());
  for (Tip& tip : tips) ++tip.joint;
  const Motion grounded(std::make_shared<const Skeleton>(joints, tips), {100, 1}, 1);
  EXPECT_EQ(contact_sheet(grounded), contact_sheet(standing(1)));
}

TEST(ContactSheet, FindsArmsByShapeIfNamesDoNotIdentifyThem) {
  const Motion collars = changed([](Joint& joint) {
    const std::string side = joint.name.starts_with("Left") ? "Left" : "Right";
    if (joint.name == side + "Arm") joint.name = side + "Shoulder";
    if (joint.name == side + "ForeArm") joint.name = side + "Elbow";
    if (joint.name == side + "Hand") joint.name = side + "Wrist";
  });
  EXPECT_EQ(contact_sheet(collars), contact_sheet(standing(1)));
  // Names without sides: the toes determine which side is left.
  const Motion sideless = changed([](Joint& joint) {
    if (!joint.name.ends_with("Eye") && joint.name != "Head") joint.name = "j";
  });
  EXPECT_EQ(contact_sheet(sideless), contact_sheet(standing(1)));
}

TEST(ContactSheet, GivesAHeadWithoutEyesAFaceIfTracksDescribeOne) {
  const auto blind = [] {
    return changed([](Joint& joint) {
      if (joint.name.ends_with("Eye")) joint.name = joint.name.starts_with("Left") ? "LeftLid" : "RightLid";
    });
  };
  const auto pupils = [](const Motion& motion) {
    const pugi::xml_document document = parsed(contact_sheet(motion));
    const auto circles = cells(document)[0].children("circle");
    return std::distance(circles.begin(), circles.end());
  };
  EXPECT_EQ(pupils(blind()), 0);
  Motion speaking = blind();
  speaking.add_track({"jawOpen", {1}});
  EXPECT_EQ(pupils(speaking), 2);
}

TEST(ContactSheet, ARestPoseAmongTheFramesDoesNotMakeTheOthersSmall) {
  const auto heads = [](bool rest) {
    Motion motion = standing(12);
    for (std::int64_t frame = rest ? 1 : 0; frame < 12; ++frame) {
      for (const char* arm : {"LeftArm", "RightArm"}) {
        const float angle = std::string(arm) == "LeftArm" ? -1.5f : 1.5f;
        motion.pose(frame).rotations[static_cast<std::size_t>(motion.skeleton().find(arm).value())] =
            AngleAxisf(angle, Vector3f::UnitZ());
      }
    }
    const pugi::xml_document document = parsed(contact_sheet(motion));
    std::vector<double> sizes;
    for (const pugi::xml_node& cell : cells(document)) {
      sizes.push_back(cell.child("ellipse").attribute("ry").as_double());
      for (const pugi::xml_node line : cell.children("line")) {
        EXPECT_GE(line.attribute("x2").as_double(), 2);
        EXPECT_LE(line.attribute("x2").as_double(), 188);
      }
    }
    return sizes;
  };
  const std::vector<double> with = heads(true);
  const std::vector<double> without = heads(false);
  EXPECT_NEAR(with[5], without[5], 0.11);
  EXPECT_LT(with[0], 0.7 * with[5]);  // smaller, so that its hands are inside the cell
}

TEST(ContactSheet, RefusesWhatItCannotDraw) {
  EXPECT_THROW(contact_sheet(standing(0)), Error);
  ContactSheetOptions beyond;
  beyond.frames = {5};
  EXPECT_THROW(contact_sheet(standing(5), beyond), Error);
  beyond.frames = {-1};
  EXPECT_THROW(contact_sheet(standing(5), beyond), Error);
  ContactSheetOptions narrow;
  narrow.columns = 0;
  EXPECT_THROW(contact_sheet(standing(5), narrow), Error);
}

}  // namespace
}  // namespace signweave

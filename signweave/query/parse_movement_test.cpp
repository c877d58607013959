#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/query/parse.h"

namespace signweave {
namespace {

using testing::HasSubstr;

TEST(ParseMovement, AWellFormedQueryParsesBackToItself) {
  struct Row {
    const char* text;
    const char* normal;
  };
  const Row rows[] = {
      {"phase = stroke & speed(right_hand) > 1.5 m/s", "phase = stroke & speed(right_hand) > 1.5 m/s"},
      {"gloss = \"VANNES\" & end(right_hand).height > shoulder",
       "gloss = \"VANNES\" & end(right_hand).height > shoulder"},
      {"speed(hand)>150cm/s", "speed(hand) > 1.5 m/s"},
      {"from(right_hand).azimuth < -30 deg", "from(right_hand).azimuth < -30 deg"},
      {"to(Left_Hand.Elevation)>=0.1rad&hand=left", "to(left_hand).elevation >= 5.729577951308232 deg & hand = left"},
      {"to(hand).distance > 90 cm | from(left_elbow).distance < 1.2",
       "to(hand).distance > 0.9 m | from(left_elbow).distance < 1.2 sw"},
      {"right_hand moves toward @left", "right_hand moves toward @left"},
      {"moves towards @self & hand moves toward @30", "hand moves toward @self & hand moves toward @30"},
      {"!(left_elbow moves toward @-30/10 within 20deg)", "!left_elbow moves toward @-30/10 within 20 deg"},
      {"Left_Hand points at @0.3,-0.1,0.8", "left_hand points at @0.3,-0.1,0.8"},
      {"(points at @30/10/1.2)->gloss=A", "hand points at @30/10 -> gloss = \"A\""},
      {"hand = left & points at @right within 15 deg during phase = stroke",
       "hand = left & hand points at @right during phase = stroke"},
      {"speed ( Right_Hand ) <= 2 m/s & hand = left", "speed(right_hand) <= 2 m/s & hand = left"},
      {"mean_speed(left_elbow) < 0.25m/s", "mean_speed(left_elbow) < 0.25 m/s"},
      {"acceleration(hand) >= 20 m/s2", "acceleration(hand) >= 20 m/s2"},
      {"mean_acceleration(hand) >= 20 m/s\xC2\xB2", "mean_acceleration(hand) >= 20 m/s2"},
      {"acceleration(hand) >= 2000cm/s^2", "acceleration(hand) >= 20 m/s2"},
      {"path(right_index_tip) > 40cm", "path(right_index_tip) > 0.4 m"},
      {"displacement(right_forearm) > 0.3", "displacement(right_elbow) > 0.3 sw"},
      {"distance(right_hand, left_hand) < 50 mm", "distance(right_hand, left_hand) < 0.05 m"},
      {"distance(hand,head).end < 0.2 sw", "distance(hand, head).end < 0.2 sw"},
      {"begin(right_hand).height >= chest", "begin(right_hand).height >= chest"},
      {"begin(right_wrist).height > -0.25", "begin(right_wrist).height > -0.25 sw"},
      {"end(left_hand) . x = Center", "end(left_hand).x = centre"},
      {"end(hand).forward != near", "end(hand).forward != near"},
      {"end(hand).openness > .5", "end(hand).openness > 0.5"},
      {"begin(hand).palm = up & end(hand).fingers = forward", "begin(hand).palm = up & end(hand).fingers = forward"},
      {"contact(right_hand) = head", "contact(right_hand) = head"},
      {"end(right_hand).contact = hand", "end(right_hand).contact = hand"},
      {"max(right_hand).height > shoulder", "max(right_hand).height > shoulder"},
      {"max(Right_Hand.Height)>0.3", "max(right_hand).height > 0.3 sw"},
      {"min ( left_elbow . x ) < -20cm", "min(left_elbow).x < -0.2 m"},
      {"end(right_hand.palm) = up", "end(right_hand).palm = up"},
      {"any(hand).forward = far & any(hand).palm != down", "any(hand).forward = far & any(hand).palm != down"},
      {"any(right_hand).contact = head", "any(right_hand).contact = head"},
      {"any(right_hand).openness < 0.2", "any(right_hand).openness < 0.2"},
      {"enters(right_hand, Chin)", "enters(right_hand).height = chin"},
      {"enters(head, center) | enters(hand, far)", "enters(head).x = centre | enters(hand).forward = far"},
      {"enters(hand).height = chin & hand = left", "enters(hand).height = chin & hand = left"},
      {"enters(hand.x) = left", "enters(hand).x = left"},
      {"max(speed(hand)) > 1 m/s", "speed(hand) > 1 m/s"},
      {"min(speed(hand)) > 10 cm/s", "speed(hand).least > 0.1 m/s"},
      {"any(acceleration(hand)) < 1 m/s2", "acceleration(hand).least < 1 m/s2"},
      {"any(acceleration(hand)) >= 1 m/s2", "acceleration(hand) >= 1 m/s2"},
      {"max(distance(hand, head)) < 1 m", "distance(hand, head).most < 1 m"},
      {"min(distance(hand, head)) < 1 m", "distance(hand, head) < 1 m"},
      {"any(distance(hand, head)) > 1 m", "distance(hand, head).most > 1 m"},
      {"max(track(jawOpen)) > 0.4", "track(\"jawOpen\") > 0.4"},
      {"any( gaze(yaw) ) < 0 deg", "gaze(yaw).least < 0 deg"},
      {"begin > 1s & begin(hand).x > 0.1", "begin > 1000ms & begin(hand).x > 0.1 sw"},
      {"begin(hand).x > 0.1 during phase = stroke", "begin(hand).x > 0.1 sw during phase = stroke"},
      {"!speed(hand) > 1 m/s -> gloss =~ /s/", "!speed(hand) > 1 m/s -> gloss =~ /s/"},
      {"path(hand) > 0.5mm", "path(hand) > 0.0005 m"},
      {"track(jawOpen) > 0.4", "track(\"jawOpen\") > 0.4"},
      {"phase = stroke & track ( \"jawOpen\" ) . begin<=.25", "phase = stroke & track(\"jawOpen\").begin <= 0.25"},
      {"mean_track(browInnerUp) >= -1", "mean_track(\"browInnerUp\") >= -1"},
      {"track(\"a \\\"b\\\" c\").Least < 1 during phase = stroke",
       "track(\"a \\\"b\\\" c\").least < 1 during phase = stroke"},
      {"gaze(yaw) > 15 deg", "gaze(yaw) > 15 deg"},
      {"gaze(\"Pitch\").end < -12.5\xC2\xB0", "gaze(pitch).end < -12.5 deg"},
      {"mean_gaze(yaw) < -15deg | gaze(yaw).least < 0.5 rad",
       "mean_gaze(yaw) < -15 deg | gaze(yaw).least < 28.64788975654116 deg"},
      {"like(\"meteo\"@1200..3400)", "like(\"meteo\"@1200..3400)"},
      {"phase = stroke & like(meteo @ 1.2s .. 3400ms, right_hand, left_elbow)",
       "phase = stroke & like(\"meteo\"@1200..3400, right_hand, left_elbow)"},
      {"gloss = A -> hand = left & like(\"say \\\"x\\\"\"@-10..20)",
       "gloss = \"A\" -> hand = left & like(\"say \\\"x\\\"\"@-10..20)"},
  };
  for (const Row& row : rows) {
    try {
      const PhaseQuery query = parse(row.text);
      EXPECT_EQ(to_string(query), row.normal);
      EXPECT_EQ(parse(to_string(query)), query) << row.text;
    } catch (const SyntaxError& error) {
      ADD_FAILURE() << row.text << '\n' << error.what() << '\n' << error.caret;
    }
  }
}

TEST(ParseMovement, EveryPointParsesFromItsName) {
  for (const std::string& word : point_words()) {
    const std::optional<Point> point = point_named(word);
    ASSERT_TRUE(point) << word;
    EXPECT_EQ(to_string(*point), word);
  }
  EXPECT_EQ(point_named("right_hand"), Point::palm(Side::right));
  EXPECT_EQ(point_named("right_wrist"), Point::of(Part::right_hand));
  EXPECT_FALSE(point_named("rigth_hand"));
}

TEST(ParseMovement, AFaultIsOneLineWithItsColumn) {
  struct Row {
    const char* text;
    std::size_t column;
    const char* says;
  };
  const Row rows[] = {
      {"speed > 1", 7, "expected '(', found '>'; name a point: speed(right_hand)"},
      {"speeed(hand) > 1 m/s", 1, "no condition is called 'speeed'; did you mean speed?"},
      {"speed() > 1 m/s", 7, "expected a point of the signer, found ')'; name one such as hand, right_hand"},
      {"speed(rigth_hand) > 1 m/s", 7, "no point is called 'rigth_hand'; did you mean right_hand"},
      {"speed(right_hand > 1 m/s", 18, "close the parenthesis after the point"},
      {"speed(right_hand, head) > 1 m/s", 17, "expected ')', found ','"},
      {"speed(right_hand).x > 1 m/s", 18,
       "'speed' has no component 'x'; leave '.x' out, or ask for begin(right_hand).x"},
      {"speed(right_hand)", 18,
       "expected a comparison after 'speed(right_hand)', found the end of the query; use one of "
       "< <= > >="},
      {"speed(right_hand) = 1 m/s", 19, "a measured value is never exactly a number; use < <= > >= with 1 m/s"},
      {"speed(right_hand) =~ /1/", 19, "expected a comparison"},
      {"speed(right_hand) > ", 21,
       "expected a value after '>', found the end of the query; write a number such as 1.5"},
      {"speed(right_hand) > 1.5", 21, "the number 1.5 lacks a unit; write a number such as 1.5 m/s"},
      {"speed(right_hand) > 1.5 & hand = left", 21, "lacks a unit"},
      {"speed(right_hand) > 1.5 m", 25, "'m' is not a unit of this quantity; write a number such as 1.5 m/s"},
      {"speed(right_hand) > 1.5 km/h", 25, "no unit is called 'km/h'"},
      {"speed(right_hand) > 1.5 m/sec", 25, "no unit is called 'm/sec'; did you mean m/s"},
      {"speed(right_hand) > 1.5.1 m/s", 21, "is not a number"},
      {"speed(right_hand) > 1e3 m/s", 21, "no unit is called 'e3'"},
      {"speed(right_hand) > 10000000 m/s", 21, "above one million"},
      {"speed(right_hand) > fast", 21, "'fast' is not a value of 'speed(right_hand)'; write a number such as 1.5 m/s"},
      {"path(hand) > 1 m/s", 16, "'m/s' is not a unit of this quantity"},
      {"distance(right_hand) < 1 cm", 20, "expected ',', found ')'; name two points"},
      {"distance(head, head) < 1 cm", 16, "has no distance to itself"},
      {"distance(head, hand).least < 1 cm", 21, "no component is called 'least'; use one of begin, end, most"},
      {"end(right_hand) > shoulder", 17,
       "expected a component after 'end(…)', found '>'; write end(right_hand).height"},
      {"end(right_hand).heigth > shoulder", 16, "no component is called 'heigth'; did you mean height?"},
      {"end(right_hand).height > sholder", 26,
       "'sholder' is not a value of 'end(right_hand).height'; did you mean shoulder?"},
      {"end(right_hand).x > left", 21, "'left' has no order; compare it with = !="},
      {"end(head).openness > 0.5", 10, "'openness' is known for hands only; use hand, right_hand or left_hand"},
      {"max(right_hand) > shoulder", 17,
       "expected a component after 'max(…)', found '>'; write max(right_hand).height"},
      {"max(right_hand).palm = up", 16, "'palm' has no value in 'max'; use any(right_hand).palm"},
      {"max(right_hand.palm) = up", 15, "'palm' has no value in 'max'; use any(right_hand).palm"},
      {"max(head).openness > 0.5", 10, "'openness' is known for hands only"},
      {"max(right_hand.heigth) > chin", 15, "no component is called 'heigth'; did you mean height?"},
      {"max(right_hand.height).x > chin", 23, "expected a comparison"},
      {"max(right_hnd).height > chin", 5, "no point is called 'right_hnd'; did you mean right_hand"},
      {"max(right_hnd.height) > chin", 5, "no point is called 'right_hnd'; did you mean right_hand"},
      {"max(mean_speed(hand)) > 1 m/s", 5,
       "'mean_speed' has no value at a single moment; max(…) takes one of speed, acceleration, distance, track, gaze, "
       "or a "
       "point: max(right_hand).height"},
      {"min(speed(hand).least) > 1 m/s", 5, "'speed(hand).least' is already the value at one moment; leave 'min' out"},
      {"any(speed(hand) > 1 m/s", 17, "close the parenthesis of 'any'"},
      {"any(right_hand).height = 0.3", 24, "a measured value is never exactly a number"},
      {"any(right_hand).x > left", 21, "'left' has no order; compare it with = !="},
      {"enters(right_hand)", 19, "expected a component after 'enters(…)'"},
      {"enters(right_hand, sholder)", 20, "expected a zone, found 'sholder'; did you mean shoulder?; use one of"},
      {"enters(right_hand, )", 20, "expected a zone, found ')'"},
      {"enters(right_hand, chin", 24, "close the parenthesis after the zone"},
      {"enters(right_hand).height > chin", 27, "a zone is either entered or not; use enters(right_hand).height = chin"},
      {"enters(right_hand).height != chin", 27,
       "'enters(right_hand).height' can be one of several at once; use !(enters(right_hand).height = …)"},
      {"enters(right_hand).height = 0.3", 29, "'0.3' is a number; use one of below_waist"},
      {"enters(right_hand).palm = up", 19, "'palm' has no value in 'enters'; use any(right_hand).palm"},
      {"from(right_hand) < 3 deg", 18,
       "expected a component after 'from(…)', found '<'; write from(right_hand).azimuth"},
      {"from(right_hand).azimut < 3 deg", 17, "no component is called 'azimut'; did you mean azimuth?"},
      {"to(right_hand).height > chin", 15, "'height' has no value in 'to'; use end(right_hand).height"},
      {"begin(right_hand).azimuth > 3 deg", 18, "'azimuth' has no value in 'begin'; use from(right_hand).azimuth"},
      {"from(right_hand).azimuth < -30", 28, "the number -30 lacks a unit; write a number such as 15 deg"},
      {"from(right_hand).distance < 30 deg", 32, "'deg' is not a unit of this quantity; write a number such as 10 cm"},
      {"right_hand moves @left", 18, "expected 'toward' after 'moves', found '@'; write right_hand moves toward @left"},
      {"right_hand points toward @left", 19,
       "expected 'at' after 'points', found 'toward'; write right_hand points at @left"},
      {"right_hand moves toward left", 25,
       "expected '@' and a locus, found 'left'; write right_hand moves toward @left"},
      {"right_hand moves toward @ left", 25,
       "expected a locus directly after '@'; write right_hand moves toward @left"},
      {"right_hand moves toward @lfet", 25,
       "there is no locus '@lfet'; did you mean @left?; use one of @left, @right, @front, @addressee, @self"},
      {"right_hand moves toward @200", 25, "'@200' is no locus: its azimuth is 200; give one from -180 to 180"},
      {"right_hand moves toward @30/", 25, "'@30/' is no locus: give a name such as @left"},
      {"right_hnd moves toward @left", 1, "no point is called 'right_hnd'; did you mean right_hand"},
      {"head points at @left", 1, "'points at' is known for hands only; use hand, right_hand or left_hand"},
      {"points at @left within", 23,
       "expected an angle after 'within', found the end of the query; write within 15 deg"},
      {"moves toward @left within 20", 27, "the number 20 lacks a unit; write a number such as 15 deg"},
      {"moves toward @left within 0 deg", 27, "an angle of 0 deg; give one above 0 deg, up to 180 deg"},
      {"moves toward @left within wide", 27, "'wide' is not a value of 'hand moves toward @left'; write a number"},
      {"moves toward @left right", 20, "expected & | -> or the end of the query, found 'right'"},
      {"form(right_hand).azimuth < 3 deg", 1, "no condition is called 'form'; did you mean from?"},
      {"contact(head) = torso", 1, "'contact' is known for hands only"},
      {"contact(hand) != torso", 15, "'contact(hand)' can be one of several at once; use !(contact(hand) = …)"},
      {"contact(hand) = 3", 17, "'3' is a number; use one of hand, head, torso"},
      {"end(hand).palm = dwon", 18, "did you mean down?"},
      {"end(hand).palm > up", 18, "has no order"},
      {"end(hand).openness > 0.5 cm", 26, "'cm' is not a unit of this quantity; write a number such as 0.5"},
      {"track", 6, "expected '(', found the end of the query; name a scalar track: track(\"jawOpen\")"},
      {"track() > 0.4", 7, "expected a track's name, found ')'; name a scalar track: track(\"jawOpen\")"},
      {"track(\" \") > 0.4", 7, "expected a track's name, found \" \""},
      {"track(jawOpen > 0.4", 15, "expected ')', found '>'; close the parenthesis after the track's name"},
      {"track(jawOpen, browDown) > 0.4", 14, "expected ')', found ','"},
      {"track(jawOpen).peak > 0.4", 15, "no component is called 'peak'; use one of least, begin, end"},
      {"track(jawOpen).beginn > 0.4", 15, "did you mean begin?; use one of least, begin, end"},
      {"mean_track(jawOpen).end > 0.4", 20, "'mean_track' has no components; leave '.end' out"},
      {"track(jawOpen) = 0.4", 16, "a measured value is never exactly a number; use < <= > >= with 0.4"},
      {"track(jawOpen) > open", 18, "'open' is not a value of 'track(\"jawOpen\")'; write a number such as 0.5"},
      {"track(jawOpen) > 0.4 deg", 22, "'deg' is not a unit of this quantity; write a number such as 0.5"},
      {"trak(jawOpen) > 0.4", 1, "no condition is called 'trak'; did you mean track?"},
      {"gaze(left) > 15 deg", 6, "the gaze has no angle 'left'; write gaze(yaw) or gaze(pitch)"},
      {"gaze(paw) > 15 deg", 6, "did you mean yaw?; write gaze(yaw) or gaze(pitch)"},
      {"mean_gaze > 15 deg", 11, "expected '(', found '>'; write mean_gaze(yaw) or mean_gaze(pitch)"},
      {"gaze(yaw) > 15", 13, "the number 15 lacks a unit; write a number such as 15 deg"},
      {"gaze(yaw) > 15 m/s", 16, "'m/s' is not a unit of this quantity; write a number such as 15 deg"},
      {"gaze(yaw) > 15 degrees", 16, "no unit is called 'degrees'"},
      {"gaze(yaw).height > 15 deg", 10, "no component is called 'height'"},
      {"(gloss = A -> gloss = B) & track(jawOpen) > 0.4", 26, "which only & duration, begin and end"},
      {"like", 5, "expected '(', found the end of the query; name a span of a recording"},
      {"like(\"meteo\")", 13, "expected '@', found ')'; give the begin and end"},
      {"like(\"meteo\"@)", 14, "'' is not a time span"},
      {"like(\"meteo\"@1200)", 14, "'1200' is not a time span; write its begin and end in milliseconds"},
      {"like(\"meteo\"@12x..15)", 14, "'12x' is not a time in whole milliseconds"},
      {"like(\"meteo\"@1.5..15)", 14, "'1.5' is not a time in whole milliseconds"},
      {"like(\"meteo\"@20..10)", 14, "swap the two times"},
      {"like(\"meteo\"@1..2, right_hnd)", 20, "no point is called 'right_hnd'"},
      {"like(\"meteo\"@1..2, hand)", 20, "name the hand to compare"},
      {"like(\"meteo\"@1..2, head, head)", 26, "'head' is named twice"},
      {"like(\"meteo\"@1..2 right_hand)", 14, "is not a time in whole milliseconds"},
      {"like(\"meteo\"@1..2) & like(\"meteo\"@3..4)", 22, "a second like(…)"},
      {"gloss = A | like(\"meteo\"@1..2)", 13, "like(…) is not a condition but orders the answers"},
      {"!like(\"meteo\"@1..2)", 2, "like(…) is not a condition"},
      {"parent(like(\"meteo\"@1..2))", 8, "like(…) is not a condition"},
      {"gloss = A overlaps like(\"meteo\"@1..2)", 20, "like(…) must be in the part before a relation"},
      {"duration(hand) > 1s", 9, "expected a comparison after 'duration', found '('"},
  };
  for (const Row& row : rows) {
    try {
      parse(row.text);
      ADD_FAILURE() << row.text;
    } catch (const SyntaxError& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_input) << row.text;
      EXPECT_EQ(error.column, row.column) << row.text << '\n' << error.what() << '\n' << error.caret;
      EXPECT_THAT(error.what(), HasSubstr(row.says)) << row.text;
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }
}

TEST(ParseMovement, AnExampleIsAllowedAmongTheOutermostConditions) {
  EXPECT_NO_THROW(parse("(gloss = A & like(\"m\"@1..2)) & hand = left"));
  EXPECT_NO_THROW(parse("(gloss = A | gloss = B) & like(\"m\"@1..2) overlaps tier(\"X\") = b -> gloss = C"));
  EXPECT_THROW(parse("(gloss = A | like(\"m\"@1..2)) & hand = left"), SyntaxError);
}

}  // namespace
}  // namespace signweave

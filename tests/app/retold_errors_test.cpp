// Errors of files, connections and devices, brought about by bad input, are told in the language of the window.

#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "anatomy/specimen.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "learn/lesson_file.h"
#include "net/socket.h"
#include "scene/recording.h"
#include "scene/recording_header.h"
#include "scene/scene_file.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"
#include "view/session/saved_work.h"
#include "view/session/settings.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view::ui {
namespace {

class RetoldErrors : public ::testing::Test {
 protected:
  void SetUp() override { set_language("de"); }
  void TearDown() override { set_language("en"); }

  /// Of what `action` throws; it must throw.
  static std::string told(const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      const auto text = retold_whole(error.what());
      EXPECT_TRUE(text) << "has no German: " << error.what();
      if (text) expect_german(*text);
      return text.value_or("");
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
  }

  static void expect_german(const std::string& text) {
    static const std::regex kEnglish(R"(\b(the|must|be|is|are|of|at|most|which|and|or|missing|cannot|with|nearest)\b)");
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, kEnglish)) << "\"" << found.str() << "\" in: " << text;
  }

  const testing::TemporaryFolder folder_;
};

TEST_F(RetoldErrors, OfFilesThatCannotBeReadOrWritten) {
  const std::string gone = (folder_ / "gone.json").string();
  EXPECT_EQ(told([&] { read_file(gone); }),
            gone + ": lässt sich nicht öffnen: Datei oder Ordner nicht gefunden. Pfad und Zugriffsrechte prüfen.");
  told([&] { read_file(folder_.path()); });
  told([&] { write_file(folder_.path(), "x"); });
  told([&] { write_file(folder_ / "no" / "such" / "file", "x"); });
  told([&] { write_file("/dev/null", "x"); });
  write_file(folder_ / "file", "x");
  told([&] { make_writable_folder(folder_ / "file" / "folder"); });
}

TEST_F(RetoldErrors, OfSettings) {
  for (const char* text :
       {"{\"schema\": 2}", "{\"schema\": 1, \"langauge\": \"de\"}", "{\"schema\": 1, \"language\": \"xx\"}", "[]", "{}",
        "{\"schema\": 1, \"tone\": 3}", "{\"schema\": 1, \"scale\": 9}", "{\"schema\": 1, \"scale\": \"x\"}",
        "{\"schema\": 1, \"mouse\": \"two\"}", "{\"schema\": 1.5}", "{\"schema\": 1, \"keys\": {\"swim\": \"H\"}}",
        "{\"schema\": 1, \"keys\": {\"search\": \"Ctrl\"}}", "{\"schema\": 1, \"keys\": 3}",
        "{\"schema\": 1, \"scale\": 1e999}", "{\"schema\": NaN}"}) {
    SCOPED_TRACE(text);
    told([&] { parse_settings(text, "s.json"); });
  }
  EXPECT_EQ(told([] { parse_settings("{\"schema\": 1, \"scale\": 9}", "s.json"); }),
            "s.json: /scale: ist 9; muss zwischen 0.75 und 2 liegen");
}

/// What the JSON library says, at every place where a file may be cut off and for each sign too many.
TEST_F(RetoldErrors, OfJsonThatIsNone) {
  const std::string whole = R"({"a": [1, -2.5e3, true, null, "t\n\u00e4"], "b": {"c": false}})";
  for (std::size_t i = 0; i < whole.size(); ++i) {
    SCOPED_TRACE(i);
    told([&] { parse_json(whole.substr(0, i), "f.json"); });
    for (const char* sign : {"}", "]", "?", "\x01", "\xff", "\\"}) {
      try {
        parse_json(whole.substr(0, i) + sign + whole.substr(i), "f.json");
      } catch (const Error& error) {
        const auto text = retold_whole(error.what());
        EXPECT_TRUE(text) << error.what();
      }
    }
  }
}

TEST_F(RetoldErrors, OfWorksAndMarks) {
  const std::string begin =
      R"({"schema": 1, "scene": "elbow", "view": {"camera": {"target_m": [0, 0, 0], "azimuth_rad": 0,
    "elevation_rad": 0, "distance_m": 1}}, "settings": {"drive": "levels"})";
  for (const char* rest : {R"(, "notes": {"ulna": ""}})", R"(, "notes": 3})", R"(, "bookmarks": [{"name": "a"}]})",
                           R"(, "tissue": "stone"})", R"(, "kept": {"c": 1}})",
                           R"(, "kept": {"a": {"drive": "swim"}}})", R"(, "kept": []})"}) {
    SCOPED_TRACE(rest);
    told([&] { parse_work(begin + rest, "w.json"); });
  }
  told([] { parse_work(R"({"schema": 9})", "w.json"); });
  told([] { parse_work(R"({"schema": 1, "scene": ""})", "w.json"); });
  write_file(folder_ / "w.json", begin + "}");
  told([&] { read_work(folder_ / "w.json", {"hock", "stifle"}); });
}

TEST_F(RetoldErrors, OfRecordings) {
  for (const std::string& bytes :
       {std::string("t_s,x"), std::string("MYOREC09"), std::string("MYOREC01"), std::string()}) {
    SCOPED_TRACE(bytes);
    told([&] { scene::parse_recording(bytes, "r.myorec"); });
  }
  scene::Recording recording;
  recording.steps.resize(1);
  recording.steps[0].excitations.resize(3);
  told([&] { scene::require_fit(recording, {}, "r.myorec"); });
}

TEST_F(RetoldErrors, OfScenesAndSpecimens) {
  for (const char* text : {"[]", R"({"schema": 1})", R"({"schema": 1, "name": "a", "title": "t", "specimen": "none"})",
                           R"({"schema": 7, "name": "a"})"}) {
    SCOPED_TRACE(text);
    told([&] { scene::parse_scene(text, "s.json", {}); });
  }
  told([] { scene::load_scene("ellbow", {}); });
  told([&] { anatomy::load_specimen(folder_.path()); });
  write_file(folder_ / "specimen.json", R"({"schema": 1, "name": "x"})");
  told([&] { anatomy::load_specimen(folder_.path()); });
}

TEST_F(RetoldErrors, OfLessons) {
  const auto specimen = testing::antagonist_hinge();
  const std::string begin = R"({"schema": 1, "key": "k", "title": "t", "scene": "elbow", "language": "en")";
  for (const std::string& text :
       {std::string(R"({"schema": 5})"), std::string("{}"), begin + "}", begin + R"(, "steps": []})",
        begin + R"(, "steps": [{"text": ""}]})", begin + R"(, "steps": [{"text": "x", "points": 3}]})",
        begin + R"(, "steps": [{"text": "x", "task": {"do": "swim"}}]})"}) {
    SCOPED_TRACE(text);
    write_file(folder_ / "l.json", text);
    told([&] { learn::load_lesson(folder_ / "l.json", specimen); });
  }
}

TEST_F(RetoldErrors, OfConnections) {
  told([] { net::parse_endpoint("host:99999", 7480); });
  told([] { net::parse_endpoint(":7480", 7480); });
  const std::string refused =
      "127.0.0.1:1: Connection refused; is `myotact serve` running there, and is this its port?";
  const auto lost = retold_whole("no connection to the server (" + refused + "); it is tried again and again");
  ASSERT_TRUE(lost);
  EXPECT_EQ(*lost,
            "keine Verbindung zum Server (127.0.0.1:1: Verbindung abgelehnt; läuft dort `myotact serve`, und ist das "
            "sein Port?); es wird immer wieder versucht");
}

/// Drivers put a cause and a remedy together, the window what it does about it.
TEST_F(RetoldErrors, OfDevicesWithCauseAndRemedy) {
  const auto told_device = retold_whole(
      "spacemouse: /dev/hidraw1: this user may not read and write it; plug the SpaceMouse in again. The mouse leads "
      "until you open a scene again.");
  EXPECT_FALSE(told_device) << "no driver gives that remedy, and an unknown clause is not passed over";
  const auto whole = retold_whole(
      "falcon: the Falcon went away while it was started (3 tries); unplug its power for ten seconds and plug it in "
      "again. The mouse leads until you open a scene again.");
  ASSERT_TRUE(whole);
  EXPECT_EQ(
      *whole,
      "falcon: der Falcon verschwand, während er gestartet wurde (3 Versuche); ihn zehn Sekunden vom Strom trennen "
      "und wieder anstecken. Bis wieder eine Szene geöffnet wird, führt die Maus.");
  EXPECT_EQ(retold("spacemouse: Charge the SpaceMouse."),
            "spacemouse: " + std::string(tr("hint.Charge the SpaceMouse.")));
}

}  // namespace
}  // namespace myotact::view::ui

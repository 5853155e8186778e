#include "stage/film.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/files.h"
#include "base/test_folder.h"

namespace parvis::stage {
namespace {
namespace fs = std::filesystem;

constexpr int film_width = 64, film_height = 36;

/// Output of a program, without the last line's end.
std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  for (int c; pipe && (c = std::fgetc(pipe)) != EOF;) text += char(c);
  if (pipe) pclose(pipe);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

Image8 grey_frame(int value) { return Image8(film_width, film_height, 4, std::uint8_t(value)); }

class FilmTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v ffmpeg > /dev/null && command -v ffprobe > /dev/null") != 0)
      GTEST_SKIP() << "skipped: no ffmpeg here";
  }

  TestFolder folder_;
};

/// Another search path for programs, until the test ends.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) : before_(std::getenv("PATH")) {
    setenv("PATH", path.c_str(), 1);
  }
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;

 private:
  std::string before_;
};

TEST_F(FilmTest, HasTheFramesTheSizeAndTheLightThatItWasGiven) {
  const fs::path file = folder_.path() / "of grey" / "a film: it's grey.mp4";
  Result<Film> film = Film::open(file, film_width, film_height, 12);
  ASSERT_TRUE(film) << to_string(film.errors());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(film->add(grey_frame(200)));
  EXPECT_FALSE(fs::exists(file)) << "it appears when it is whole";
  const Status status = film->finish();
  ASSERT_TRUE(status) << to_string(status.errors());

  const std::string name = '"' + file.string() + '"';
  EXPECT_EQ(output_of("ffprobe -v error -count_frames -select_streams v -show_entries "
                      "stream=codec_name,width,height,r_frame_rate,nb_read_frames -of csv=p=0 file:" +
                      name),
            "h264,64,36,12/1,5");
  const std::string pixels =
      output_of("ffmpeg -v error -i file:" + name + " -frames:v 1 -f rawvideo -pix_fmt gray -");
  ASSERT_EQ(pixels.size(), std::size_t(film_width) * film_height);
  for (const char pixel : pixels)
    EXPECT_NEAR(int(static_cast<unsigned char>(pixel)), 200, 3);  // H.264 is lossy
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1) << "nothing beside the film";
}

TEST_F(FilmTest, HasTheSoundThatItWasGiven) {
  const fs::path file = folder_.path() / "heard.mp4";
  Result<Film> film = Film::open(file, film_width, film_height, 12);
  ASSERT_TRUE(film) << to_string(film.errors());
  for (int i = 0; i < 12; ++i) ASSERT_TRUE(film->add(grey_frame(200)));
  // A second of silence: one channel of 16 bits at 8 kHz.
  std::string wave(
      "RIFF\xa4\x3e\0\0WAVEfmt \x10\0\0\0\1\0\1\0\x40\x1f\0\0\x80\x3e\0\0\2\0\x10\0data\x80\x3e\0\0", 44);
  wave.append(16'000, '\0');
  const Status status = film->finish(wave);
  ASSERT_TRUE(status) << to_string(status.errors());
  EXPECT_EQ(output_of("ffprobe -v error -show_entries stream=codec_name -of csv=p=0 file:" + file.string()),
            "h264\naac");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "nothing beside the film";
}

TEST_F(FilmTest, TakesANameWithAColonInTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  Result<Film> film = Film::open("at-12:30.mp4", film_width, film_height, 24);
  const bool is_written = film && film->add(grey_frame(90)) && film->finish();
  fs::current_path(before);
  EXPECT_TRUE(is_written);
  EXPECT_TRUE(fs::exists(folder_.path() / "at-12:30.mp4"));
}

TEST_F(FilmTest, LeavesNothingBehindWhenItIsGivenUp) {
  {
    Result<Film> film = Film::open(folder_.path() / "half.mp4", film_width, film_height, 24);
    ASSERT_TRUE(film) << to_string(film.errors());
    ASSERT_TRUE(film->add(grey_frame(90)));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(FilmTest, KeepsAnEarlierFilmUntilTheNewOneIsWhole) {
  const fs::path file = folder_.write("film.mp4", "the film of yesterday");
  {
    Result<Film> film = Film::open(file, film_width, film_height, 24);
    ASSERT_TRUE(film) << to_string(film.errors());
    ASSERT_TRUE(film->add(grey_frame(90)));
  }
  EXPECT_EQ(*read_file(file), "the film of yesterday");
}

TEST_F(FilmTest, ReportsAnEncoderThatFailsAndLeavesNothingBehind) {
  const fs::path program =
      folder_.write("bin/ffmpeg", "#!/bin/sh\neval last=\\${$#}; touch \"${last#file:}\"; exit 1\n");
  fs::permissions(program, fs::perms::owner_all);
  const SearchPath path((folder_.path() / "bin").string() + ":/usr/bin:/bin");
  const fs::path films = folder_.path() / "films";
  Result<Film> film = Film::open(films / "film.mp4", film_width, film_height, 24);
  ASSERT_TRUE(film) << to_string(film.errors());
  bool is_told = false;
  for (int i = 0; i < 100 && !is_told; ++i) is_told = !film->add(grey_frame(90));  // a pipe holds some frames
  EXPECT_TRUE(is_told);
  const Status status = film->finish();
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("film.mp4"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(films));
}

TEST_F(FilmTest, NamesTheProgramThatIsMissing) {
  const SearchPath path(folder_.path().string());
  const Result<Film> film = Film::open(folder_.path() / "film.mp4", film_width, film_height, 24);
  ASSERT_FALSE(film);
  EXPECT_NE(to_string(film.errors()).find("ffmpeg"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(FilmTest, RefusesWhatCannotBeAFilm) {
  EXPECT_FALSE(Film::open(folder_.path() / "odd.mp4", 63, 36, 24));
  EXPECT_FALSE(Film::open(folder_.path() / "odd.mp4", 64, 35, 24));
  EXPECT_FALSE(Film::open(folder_.path() / "film.gif", film_width, film_height, 24));
  const fs::path file = folder_.write("a_file", "in the way");
  EXPECT_FALSE(Film::open(file / "film.mp4", film_width, film_height, 24));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);

  Result<Film> film = Film::open(folder_.path() / "film.mp4", film_width, film_height, 24);
  ASSERT_TRUE(film) << to_string(film.errors());
  EXPECT_FALSE(film->add(Image8(film_width, film_height + 2, 3)));
}

}  // namespace
}  // namespace parvis::stage

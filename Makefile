# The Voxel Light Workbook. `make help` lists the commands.
#
# Variables for the command line: CC=gcc|clang, BUILD=folder, OPT="-O2 -g", WERROR=1, SANITIZE=-fsanitize=…, V=1 (print whole commands),
# ARGS="options of make NN".
# Everything made goes to $(BUILD) and out/. A change of compiler or flags rebuilds (the stamp $(BUILD)/flags); clang has a folder of its own.
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules --no-print-directory
.DEFAULT_GOAL := all
.DELETE_ON_ERROR:

ifeq ($(origin CC),default)
CC := gcc
endif
CC    ?= gcc
CXX   := $(if $(findstring clang,$(CC)),$(subst clang,clang++,$(CC)),$(subst gcc,g++,$(CC)))
BUILD ?= build$(if $(findstring clang,$(CC)),/clang)
OPT   ?= -O2 -g

# One pkg-config call, anew in each make: `make run` installs first and builds in a second make, which sees what has arrived. OSMesa may be
# missing (it left Mesa in 25.1): the programs are then built without it and run on EGL.
PACKAGES := egl glfw3 OpenImageIO assimp gsl
PKG      := $(shell { pkg-config --cflags --libs $(PACKAGES) $$(pkg-config --exists osmesa && echo osmesa); } 2>/dev/null)
SYSTEM   := $(patsubst -I%,-isystem %,$(filter -I% -D%,$(PKG)))
PKG_LIBS := $(filter-out -I% -D% -std=%,$(PKG))

WARN     := -Wall -Wextra -Wshadow -Wconversion -Wno-psabi $(if $(WERROR),-Werror)
CPPFLAGS := -D_GNU_SOURCE -Icommon $(SYSTEM)
CFLAGS   := -std=gnu17 $(OPT) $(WARN) $(SANITIZE)
CXXFLAGS := -std=c++17 $(OPT) $(WARN) $(SANITIZE)
LDLIBS   := -Wl,--as-needed $(PKG_LIBS) -lembree3 -lpthread -ldl -lm

# One short line a file: what is made, by what.
SAY = $(if $(V),,@printf '  %-4s %s\n' '$(1)' '$(2)';)

OBJ      := $(BUILD)/obj
objects   = $(patsubst %,$(OBJ)/%.o,$(wildcard $(1)))
COMMON   := $(call objects,common/*.c common/*.cpp)
CHAPTERS := $(sort $(patsubst chapters/%/main.c,%,$(wildcard chapters/*/main.c)))
PROGRAMS := $(addprefix $(BUILD)/,$(CHAPTERS))
TECHNIQUES := $(filter-out %/main.c.o,$(call objects,chapters/*/*.c))
# The exercises' tests are a program of their own: it loads four libraries where the others load 260, once a test.
EXERCISE_TESTS := test_course% test_grade%
TESTS    := $(call objects,tests/test_*.c)
TESTS_OF_EXERCISES := $(filter $(EXERCISE_TESTS:%=$(OBJ)/tests/%),$(TESTS))
TESTS    := $(filter-out $(TESTS_OF_EXERCISES),$(TESTS))
SLOW     := $(call objects,tests/slow_*.c)
SUPPORT  := $(call objects,tests/support*.c)
TOOLS    := $(patsubst tests/tools/%.c,$(BUILD)/%,$(wildcard tests/tools/*.c)) $(patsubst tests/%.c,$(BUILD)/%,$(wildcard tests/triangle.c))
# The graders' programs, one main each; the rest of tests/grade/ is a library that they and the tests share.
GRADERS  := grade prove margins course course_picture
GRADE    := $(filter-out $(GRADERS:%=$(OBJ)/tests/grade/%.c.o),$(call objects,tests/grade/*.c))
SOURCES  := $(wildcard common/*.c common/*.cpp chapters/*/*.c tests/*.c tests/tools/*.c tests/grade/*.c)

# What a tree that was handed out lacks (tests/tools/handout.sh), said in one line.
OF_AUTHORS := exercises record handout grade margins test-exercise-mutants check-times test test-now test-all test-slow test-clang test-mutants \
  test-readme sanitize lessons lessons-check pictures figures worst format lint compile_commands.json
ifeq ($(wildcard solutions),)
ifneq ($(filter $(OF_AUTHORS),$(MAKECMDGOALS)),)
$(error make $(firstword $(filter $(OF_AUTHORS),$(MAKECMDGOALS))) needs solutions and tests, and this tree was handed out without them; make next says what to do here)
endif
endif

# A student waits for these: all processors build what is missing.
ifneq ($(filter next progress check watch hint solution,$(MAKECMDGOALS)),)
MAKEFLAGS += --jobs=$(shell nproc)
endif

export BUILD
export MESA_SHADER_CACHE_DIR := $(abspath $(if $(filter build/%,$(BUILD)),build,$(BUILD)))/mesa-cache

all: $(PROGRAMS) ## build every program into build/ (the default)
	@mkdir -p out

# --- objects and programs -------------------------------------------------------------------------------------------------
# Stamps are rewritten only when their text changes, so they are newer than an object only when it must be made again.
STAMP = @mkdir -p $(@D); echo '$(1)' | cmp -s - $@ || echo '$(1)' > $@
$(BUILD)/flags: FORCE
	$(call STAMP,$(CC) $(CXX) $(CPPFLAGS) $(CFLAGS) $(CXXFLAGS))
$(BUILD)/members: FORCE
	$(call STAMP,$(COMMON) $(TECHNIQUES) $(GRADE))
FORCE:

$(OBJ)/%.c.o: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call SAY,cc,$<)$(CC) $(CPPFLAGS) $(DEFINE) $(CFLAGS) -MMD -MP -c $< -o $@
$(OBJ)/%.cpp.o: %.cpp $(BUILD)/flags
	@mkdir -p $(@D)
	$(call SAY,c++,$<)$(CXX) $(CPPFLAGS) $(CXXFLAGS) -MMD -MP -c $< -o $@

# truth's cache keys hold a hash of truth's own source, so that a changed truth is computed anew.
TRUTH := $(wildcard common/truth*.[ch])
$(filter $(OBJ)/common/truth%,$(COMMON)): DEFINE = -DTRUTH_SOURCE_HASH="\"$$(cat $(TRUTH) | sha1sum | cut -c1-40)\""
$(filter $(OBJ)/common/truth%,$(COMMON)): $(TRUTH)

# P: members by their whole paths, since two chapters may have a file of one name.
ARCHIVE = @rm -f $@; ar rcsP $@ $(filter %.o,$^)
$(BUILD)/libcommon.a: $(COMMON) $(BUILD)/members
	$(ARCHIVE)
$(BUILD)/libtechniques.a: $(TECHNIQUES) $(BUILD)/members
	$(ARCHIVE)
$(BUILD)/libgrade.a: $(GRADE) $(BUILD)/members
	$(ARCHIVE)

LINK = $(call SAY,link,$@)$(CXX) $(SANITIZE) $(filter %.o %.a,$^) $(1) $(LDLIBS) -o $@
define CHAPTER
$(BUILD)/$(1): $(call objects,chapters/$(1)/*.c) $(BUILD)/libcommon.a
	$$(call LINK)
.PHONY: $(firstword $(subst _, ,$(1)))
$(firstword $(subst _, ,$(1))): $(BUILD)/$(1)
	$$< $$(ARGS)
$(BUILD)/only/test_$(firstword $(subst _, ,$(1)))%: $(filter-out %/main.c.o,$(call objects,chapters/$(1)/*.c))
endef
$(foreach c,$(CHAPTERS),$(eval $(call CHAPTER,$(c))))

# The page of make report, of several files.
REPORT  := $(wildcard tests/report/*.c)
SOURCES += $(REPORT)
TOOLS   += $(BUILD)/report
$(BUILD)/report: $(call objects,tests/report/*.c) $(BUILD)/libcommon.a
	$(call LINK)
$(BUILD)/only/test_report: | $(BUILD)/report
$(BUILD)/only/test_speed: | $(BUILD)/speed
-include $(patsubst %.c,$(OBJ)/%.c.d,$(REPORT))

# The proof that gl and shader stand alone: nothing else is linked.
$(BUILD)/triangle: $(OBJ)/tests/triangle.c.o $(call objects,common/base*.c common/gl*.c common/shader*.c)
	$(call LINK)
# It runs chapter 04's own methods.
$(BUILD)/worst: $(OBJ)/tests/tools/worst.c.o $(call objects,chapters/04_airlight/closed_form.c chapters/04_airlight/scenes.c) $(BUILD)/libcommon.a
	$(call LINK)
$(BUILD)/test_slow $(BUILD)/only/slow_04_airlight: | $(BUILD)/worst
$(patsubst tests/tools/%.c,$(BUILD)/%,$(filter-out %/worst.c,$(wildcard tests/tools/*.c))): $(BUILD)/%: $(OBJ)/tests/tools/%.c.o $(BUILD)/libcommon.a
	$(call LINK)

# --- exercises ------------------------------------------------------------------------------------------------------------
# solutions/ holds answers and stubs in one file; tests judge the two trees that are cut from it, never what a student has made of exercises/.
SOLUTIONS := $(wildcard solutions/*/*)
$(BUILD)/stubs.made $(BUILD)/solutions.made: $(BUILD)/%.made: $(SOLUTIONS) tests/tools/exercises.sh
	@mkdir -p $(@D)
	@sh tests/tools/exercises.sh $* $(BUILD)/$*
	@touch $@
# How an exercise is compiled and linked, for the programs that do it: a word a line, the linker's after an empty one; @ stands for this folder.
$(BUILD)/exercise_commands: FORCE
	@mkdir -p $(@D)
	@{ printf '%s\n' $(CC) -D_GNU_SOURCE -I@/common $(SYSTEM) $(filter-out -Werror,$(CFLAGS)) \
	  $(if $(findstring clang,$(CC)),-ferror-limit=2,-fmax-errors=2); echo; printf '%s\n' $(LDLIBS) -lstdc++; } >$@.new
	@cmp -s $@.new $@ && rm $@.new || mv $@.new $@
# What exercises include, and no more: the first check of a fresh tree builds it while somebody waits.
$(BUILD)/libexercise.a: $(call objects,$(foreach module,base exercise gl linear shader,common/$(module).c*))
	$(ARCHIVE)
EXERCISES := $(BUILD)/course_picture $(BUILD)/exercise_commands $(BUILD)/libexercise.a
$(BUILD)/course_picture: $(OBJ)/common/image.cpp.o
$(GRADERS:%=$(BUILD)/%): $(BUILD)/%: $(OBJ)/tests/grade/%.c.o $(BUILD)/libgrade.a $(BUILD)/libexercise.a
	$(call LINK,-ljansson)

next: $(BUILD)/course ## the first exercise that you have not solved: what to do, what to read, which file to open
	@$(BUILD)/course next
progress: $(BUILD)/course ## how far you are
	@$(BUILD)/course progress
check: $(BUILD)/course $(EXERCISES) ## does your exercise work? EX=01.2 names it, else it is the first unsolved
	@$(BUILD)/course check $(EX)
watch: $(BUILD)/course $(EXERCISES) ## check EX=01.2 again whenever you save
	@$(BUILD)/course watch $(EX)
hint: $(BUILD)/course ## the next of three hints for EX=01.2
	@$(BUILD)/course hint $(EX)
solution: $(BUILD)/course ## our solution of EX=01.2, once yours passes
	@$(BUILD)/course solution $(EX)
exercises: ## make exercises/ from solutions/; files that you have worked on stay as they are
	@sh tests/tools/exercises.sh update
record: $(BUILD)/course $(EXERCISES) $(BUILD)/solutions.made ## for authors: record what EX=01.2 should give, and what each known mistake gives
	@rm -rf $(BUILD)/wrong/$(EX)
	@for diff in tests/mutants/exercises/$(or $(EX),none)/*.diff; do name=$$(basename $$diff .diff); \
	  sh tests/tools/exercises.sh wrong $(EX) $$name $(BUILD)/wrong/$(EX)/$$name || exit 1; done
	@$(BUILD)/course record $(EX)
handout: ## for instructors: what a student gets, into DIR=folder; EX="01.1 01.2" chooses, else all
	@sh tests/tools/handout.sh "$(DIR)" $(EX)

# Both trees and all that a program is linked with: what a grader copies to a scratch folder of its own.
GRADING := $(EXERCISES) $(BUILD)/stubs.made $(BUILD)/solutions.made
grade: $(BUILD)/grade $(GRADING) ## for instructors: grade DIR=submission into OUT=folder (out/grade); SEED=n for the same inputs again, EX="02.2 02.3"
	@$(BUILD)/grade "$(DIR)" "$(or $(OUT),out/grade)" --seed "$(SEED)" --exercises "$(EX)"
# Each mistake of tests/mutants/exercises/ID/ in a tree of its own.
$(BUILD)/wrong.made: $(SOLUTIONS) $(wildcard tests/mutants/exercises/*/*.diff) tests/tools/exercises.sh
	@rm -rf $(BUILD)/wrong && mkdir -p $(BUILD)/wrong
	@for diff in $(wildcard tests/mutants/exercises/*/*.diff); do id=$$(basename $$(dirname $$diff)) name=$$(basename $$diff .diff); \
	  sh tests/tools/exercises.sh wrong $$id $$name $(BUILD)/wrong/$$id/$$name || exit 1; done
	@touch $@
test-exercise-mutants: $(BUILD)/prove $(GRADING) $(BUILD)/wrong.made ## each solution must get all points, each stub none, each known mistake lose just what its table says and earn its sentence
	@$(BUILD)/prove $(EX)
check-times: $(BUILD)/solutions.made ## how long make check takes in a fresh handout, for the first time and warm, by exercise
	@sh tests/tools/check_times.sh $(BUILD)/solutions
margins: $(BUILD)/margins $(GRADING) $(BUILD)/wrong.made ## how far solutions and mistakes keep from each tolerance, over compilers, optimization, GL platforms, threads
	@$(BUILD)/margins $(EX)

# --- tests ----------------------------------------------------------------------------------------------------------------
# One test file alone: make build/only/test_scene. A chapter's test (test_01_…) is linked with its chapter's technique.
$(BUILD)/only/%: $(OBJ)/tests/%.c.o $(SUPPORT) $(BUILD)/libtechniques.a $(BUILD)/libgrade.a $(BUILD)/libcommon.a
	@mkdir -p $(@D)
	$(call LINK,-lcriterion -ljansson)
$(BUILD)/only/test_course $(BUILD)/only/test_course_manifest $(BUILD)/only/slow_course: | $(BUILD)/course $(GRADING)
LIGHT := $(call objects,tests/support_course.c tests/support_grade.c) $(BUILD)/libgrade.a $(BUILD)/libexercise.a
$(patsubst tests/%.c,$(BUILD)/only/%,$(wildcard tests/*_course*.c tests/*_grade*.c)): $(BUILD)/only/%: $(OBJ)/tests/%.c.o $(LIGHT)
	@mkdir -p $(@D)
	$(call LINK,-lcriterion -ljansson)
$(BUILD)/test_exercises: $(TESTS_OF_EXERCISES) $(LIGHT)
	$(call LINK,-lcriterion -ljansson)
$(BUILD)/test_all: $(TESTS) $(SUPPORT) $(BUILD)/libtechniques.a $(BUILD)/libgrade.a $(BUILD)/libcommon.a
	$(call LINK,-lcriterion -ljansson)
$(BUILD)/test_slow: $(SLOW) $(SUPPORT) $(BUILD)/libtechniques.a $(BUILD)/libgrade.a $(BUILD)/libcommon.a
	$(call LINK,-lcriterion -ljansson)

# Graders' tests compile exercises themselves.
$(BUILD)/only/test_grade $(BUILD)/only/slow_grade $(BUILD)/test_exercises $(BUILD)/test_slow: | $(GRADING)

test: ## install what tests need, build, run every fast test; JUnit in build/junit.xml and build/junit_exercises.xml
	@$(MAKE) deps-test
	@$(MAKE) test-now
test-now: $(PROGRAMS) $(TOOLS) $(BUILD)/test_all $(BUILD)/test_exercises $(BUILD)/course $(GRADING)
	@sh tests/tools/run_tests.sh $(BUILD)/test_exercises $(BUILD)/junit_exercises.xml
	@sh tests/tools/run_tests.sh $(BUILD)/test_all $(BUILD)/junit.xml

test-all: ## make test and what is slow: slow tests, sanitizers, clang, mutants, the README's commands (TESTED=1: make test has just passed)
	$(if $(TESTED),,@$(MAKE) test)
	$(if $(SLOW),@$(MAKE) test-slow)
	@$(MAKE) sanitize
	@$(MAKE) test-clang
	@$(MAKE) test-mutants
	@$(MAKE) test-exercise-mutants
	@$(MAKE) check-times
	@$(MAKE) test-readme
	@cat $(BUILD)/*.synthesis $(BUILD)/sanitize/*.synthesis $(BUILD)/clang/*.synthesis
test-slow: $(PROGRAMS) $(TOOLS) $(BUILD)/test_slow $(BUILD)/course $(GRADING)
	@sh tests/tools/run_tests.sh $(BUILD)/test_slow $(BUILD)/junit_slow.xml
test-clang:
	@$(MAKE) CC=clang BUILD=build/clang WERROR=1 test-now
test-mutants: $(BUILD)/test_all $(BUILD)/test_exercises ## each tests/mutants/code/*.diff must turn the test that it names red
	@sh tests/tools/mutants.sh
test-readme: $(PROGRAMS) $(BUILD)/compare ## run the commands that README and lessons print
	@sh tests/tools/readme_commands.sh README.md chapters/README.md $(wildcard chapters/*/README.md)

SANITIZERS := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
sanitize: ## build with address and undefined-behaviour sanitizers into build/sanitize and run the tests there
	@rm -rf build/sanitize/log && mkdir -p build/sanitize/log
	@ASAN_OPTIONS=abort_on_error=1:log_path=$(CURDIR)/build/sanitize/log/report UBSAN_OPTIONS=abort_on_error=1:print_stacktrace=1 \
	  LSAN_OPTIONS=exitcode=0:suppressions=$(CURDIR)/tests/tools/lsan.supp:print_suppressions=0 \
	  $(MAKE) BUILD=build/sanitize OPT="-O1 -g" SANITIZE="$(SANITIZERS)" WERROR= test-now
	@sh tests/tools/sanitizer_logs.sh build/sanitize/log

# --- what a reader wants ----------------------------------------------------------------------------------------------------
run: ## install what is missing, build, render every chapter to out/ and out/index.html
	@$(MAKE) deps
	@$(MAKE) run-now
run-now: $(PROGRAMS) $(if $(wildcard tests/tools/compare.c),$(BUILD)/compare)
	@sh tests/tools/render_all.sh $(BUILD) out $(CHAPTERS)

deps: ## install what make run needs (Debian packages; each is named with its reason first)
	@sh tests/tools/deps.sh run
deps-test: ## install what make test, test-all and lint need
	@sh tests/tools/deps.sh run test
deps-book: ## install what make lessons, pictures and figures need
	@sh tests/tools/deps.sh run book

lessons: ## rewrite listings and measured numbers in chapters/**/README.md
	@sh tests/tools/lessons.sh write chapters/README.md $(wildcard chapters/*/README.md)
lessons-check: ## fail where a listing, a number or a picture in a lesson is stale
	@sh tests/tools/lessons.sh check chapters/README.md $(wildcard chapters/*/README.md)
pictures: $(PROGRAMS) ## render the lessons' pictures (chapters/NN_name/pictures.txt)
	@for chapter in $(CHAPTERS); do sh tests/tools/pictures.sh $(BUILD)/$$chapter chapters/$$chapter || exit 1; done
figures: $(PROGRAMS) $(BUILD)/figure $(BUILD)/speed ## measure each chapter's sweep and stability table and draw them (chapters/NN_name/figures.txt)
	@for chapter in $(CHAPTERS); do sh tests/tools/figures.sh $(BUILD) $$chapter || exit 1; done
worst: $(BUILD)/worst ## search 100 000 random rays for the worst views of chapter 04's methods: its stability table's last rows
	@$< > chapters/04_airlight/worst.inc.tmp && mv chapters/04_airlight/worst.inc.tmp chapters/04_airlight/worst.inc
report: $(PROGRAMS) $(BUILD)/report ## measure every chapter, at most 10 minutes each, write out/report/index.html; goes on where it stopped. QUICK=1: 5 minutes in all, FULL=1: the widest
	@sh tests/tools/report.sh $(BUILD) out/report chapters $(CHAPTERS)

# --- for those who change the code -------------------------------------------------------------------------------------------
FORMATTED := $(filter-out common/gl_functions.h,$(wildcard common/*.[ch] common/*.cpp chapters/*/*.[ch] tests/*.[ch] tests/tools/*.[ch] tests/grade/*.[ch] tests/report/*.[ch] solutions/*/*.[ch]))
format: ## clang-format every C and C++ file in place
	clang-format -i $(FORMATTED)
lint: compile_commands.json ## format, clang-tidy, cppcheck, include edges, line counts, unused shaders and functions
	@sh tests/tools/lint.sh $(FORMATTED)
compile_commands.json: Makefile $(SOURCES) ## for clangd and clang-tidy
	@sh tests/tools/compile_commands.sh '$(CC) $(CPPFLAGS) $(CFLAGS)' '$(CXX) $(CPPFLAGS) $(CXXFLAGS)' $(SOURCES) > $@.tmp && mv $@.tmp $@

clean: ## remove build/ and out/ (a student's .progress stays)
	rm -rf build out compile_commands.json
help: ## this list
	@awk -f tests/tools/help.awk -v without="$(if $(wildcard solutions),,$(OF_AUTHORS))" $(firstword $(MAKEFILE_LIST))
	@for chapter in $(CHAPTERS); do printf '  %-16s build and open chapters/%s (ARGS="--help" lists its options)\n' $${chapter%%_*} $$chapter; done

-include $(patsubst %.o,%.d,$(COMMON) $(call objects,chapters/*/*.c tests/*.c tests/tools/*.c tests/grade/*.c tests/report/*.c))
.PHONY: all test test-now test-all test-slow test-clang test-mutants test-readme sanitize run run-now deps deps-test deps-book \
  grade test-exercise-mutants check-times margins next progress check watch hint solution exercises record handout lessons lessons-check pictures figures worst report format lint clean help FORCE

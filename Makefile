# make            build/whit, build/libwhit.a
# make demo       install what is missing, build, render a picture
# make check      install what the tests need, build, run every test (SAN=1: under ASan and UBSan)
# make layers     does every file include only rooms further up?
# Other targets stand below, each with a line of its own.

BUILD   ?= build
CC      ?= gcc
WARN    := -Wall -Wextra -Wshadow -Wconversion
OPT     ?= -O2
CFLAGS  ?= $(OPT) -g
STD     := -std=c17 -D_GNU_SOURCE -ffp-contract=off -fno-math-errno -Isrc -Iinclude
LIBS    := -lm -pthread
SAN     ?= 0
ifeq ($(SAN),1)
  BUILD := $(BUILD)/san
  CFLAGS += -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer
  LDFLAGS += -fsanitize=address,undefined
endif

# Optional libraries: found by pkg-config. The build works without them, and
# the program says what is missing when a scene asks for it.
have = $(shell pkg-config --exists $(1) 2>/dev/null && echo 1)
define optional
ifeq ($$(call have,$(2)),1)
  FEATURES += -DHAVE_$(1) $$(shell pkg-config --cflags $(2))
  LIBS += $$(shell pkg-config --libs $(2))
endif
endef
# The same for those that few scenes need and that bring a dozen others along: opened by name at the first use (base/library.h).
# Where the name cannot be found out they are linked.
soname = $(shell readelf -d "$$($(CC) -print-file-name=lib$(1).so)" 2>/dev/null | sed -n 's/.*(SONAME).*\[\(.*\)\]/\1/p')
define late
ifeq ($$(call have,$(2)),1)
  FEATURES += -DHAVE_$(1) $$(shell pkg-config --cflags $(2))
  $(1)_NAME := $$(call soname,$(3))
  ifeq ($$($(1)_NAME),)
    LIBS += $$(shell pkg-config --libs $(2))
    FEATURES += -DLIBRARY_$(1)=NULL
  else
    FEATURES += -DLIBRARY_$(1)='"$$($(1)_NAME)"'
  endif
endif
endef
$(eval $(call optional,PNG,libpng))
$(eval $(call late,JPEG,libjpeg,jpeg))
$(eval $(call late,GIF,libgif,gif))
$(eval $(call late,FREETYPE,freetype2,freetype))
$(eval $(call late,TIFF,libtiff-4,tiff))
$(eval $(call late,FONTCONFIG,fontconfig,fontconfig))
LIBS += -ldl

# *_kernel.c is built once per instruction set, each object exporting names with the set pasted on (base/cpu.h).
ARCH    := $(shell $(CC) -dumpmachine 2>/dev/null | cut -d- -f1)
ISAS    := base
ifeq ($(ARCH),x86_64)
  ISAS += avx2 avx512
endif
ISA_base   :=
ISA_avx2   := -mavx2 -DLANES=16
ISA_avx512 := -mavx512f -mavx512vl -mavx512dq -mavx512bw -mprefer-vector-width=512 -DLANES=16

KERNEL_SRC := $(sort $(wildcard src/*/*_kernel.c))
LIB_SRC := $(filter-out $(KERNEL_SRC),$(sort $(wildcard src/*/*.c))) src/registry.c
KERNEL_OBJ := $(foreach isa,$(ISAS),$(KERNEL_SRC:%.c=$(BUILD)/%.$(isa).o))
LIB_OBJ := $(LIB_SRC:%.c=$(BUILD)/%.o) $(KERNEL_OBJ)
TEST_SRC := $(sort $(wildcard tests/unit/*/test_*.c))
TEST_BIN := $(TEST_SRC:%.c=$(BUILD)/%)
TEST_LIB := $(patsubst %.c,$(BUILD)/%.o,$(wildcard tests/unit/lib/*.c))

all: $(BUILD)/whit

$(BUILD)/libwhit.a: $(LIB_OBJ)
	@rm -f $@
	$(AR) rcs $@ $^

# Not optimised at link time: with -O3 that gained 3 %, and changed last bits of pictures (POV-Ray's stackertransp): bytes must not
# depend on how the program was linked.
$(BUILD)/whit: $(BUILD)/src/main.o $(BUILD)/libwhit.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/src/%.o: src/%.c
	@mkdir -p $(@D)
	$(CC) $(STD) $(WARN) $(CFLAGS) $(FEATURES) -MMD -MP -c -o $@ $<

define kernel_rule
$(BUILD)/src/%_kernel.$(1).o: src/%_kernel.c
	@mkdir -p $$(@D)
	$$(CC) $$(STD) $$(WARN) $$(CFLAGS) -O3 -Wno-psabi $$(ISA_$(1)) -DISA=$(1) -MMD -MP -c -o $$@ $$<
endef
$(foreach isa,$(ISAS),$(eval $(call kernel_rule,$(isa))))

# Unit tests: every tests/unit/<room>/test_*.c is a program of its own; tests/unit/lib/ is shared among them.
$(BUILD)/tests/unit/lib/%.o: tests/unit/lib/%.c
	@mkdir -p $(@D)
	$(CC) $(STD) $(WARN) $(CFLAGS) $(FEATURES) -Itests/unit -MMD -MP -c -o $@ $<

$(BUILD)/tests/unit/%: tests/unit/%.c $(TEST_LIB) $(BUILD)/libwhit.a
	@mkdir -p $(@D)
	$(CC) $(STD) $(WARN) $(CFLAGS) $(LDFLAGS) $(FEATURES) -Itests/unit -MMD -MP -o $@ $< $(TEST_LIB) $(BUILD)/libwhit.a -lcmocka $(LIBS)

unit: $(BUILD)/whit $(TEST_BIN)

# Everything: unit tests, command line, pictures. Ends with "N passed, N failed".
check:
	@tests/packages check
	+@$(MAKE) --no-print-directory -s -j$$(nproc 2>/dev/null || echo 2) check-only

check-only: layers unit
	@BUILD=$(BUILD) tests/run $(BUILD) $(TEST_BIN)

layers:
	@tests/layers

# A picture for a newcomer: installs what building needs, builds, renders, says where it is.
demo:
	@tests/packages demo
	+@$(MAKE) --no-print-directory -s -j$$(nproc 2>/dev/null || echo 2) $(BUILD)/whit
	@$(BUILD)/whit scenes/showpiece.pov +W800 +H600 +A0.3 +O$(BUILD)/showpiece.png
	@echo "the picture is $(CURDIR)/$(BUILD)/showpiece.png"

# POV-Ray's pictures of scenes/ again, into reference/ (needs povray).
reference:
	@tests/reference

# Time and memory beside povray, in one run.
# (BENCH=--only=TEXT: some rows.)
bench: $(BUILD)/whit
	@BUILD=$(BUILD) tests/bench/bench $(BENCH)

# POV-Ray's example scenes beside povray's pictures: verdicts, CPU, an HTML page. WHIT_CORPUS: a folder of ready pictures.
corpus: $(BUILD)/whit
	@BUILD=$(BUILD) tests/corpus $(CORPUS)

# All that comes before the first ray against libFuzzer (needs clang) for FUZZ_TIME seconds; findings and the grown corpus stay in build/fuzz/.
FUZZ_TIME ?= 60
FUZZ := $(BUILD)/fuzz
FUZZ_FLAGS := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined

fuzz:
	+@$(MAKE) --no-print-directory BUILD=$(FUZZ) CC=clang CFLAGS="$(FUZZ_FLAGS) -fsanitize=fuzzer-no-link -w" $(FUZZ)/libwhit.a
	clang $(STD) $(FUZZ_FLAGS) -fsanitize=fuzzer -o $(FUZZ)/fuzz_scene tests/fuzz/fuzz_scene.c $(FUZZ)/libwhit.a $(LIBS)
	@mkdir -p $(FUZZ)/corpus $(FUZZ)/found $(FUZZ)/work
	@tests/fuzz/make-seeds $(FUZZ)/seeds
	@sed -n 's/^KEYWORD(\([a-z0-9_]*\),.*/"\1"/p' src/sdl/keyword.def > $(FUZZ)/words
	cd $(FUZZ)/work && ../fuzz_scene -max_total_time=$(FUZZ_TIME) -timeout=10 -rss_limit_mb=2000 -max_len=8192 -dict=../words \
	    -artifact_prefix=../found/ ../corpus ../seeds

clean:
	rm -rf $(BUILD)

.PHONY: bench fuzz all unit check check-only layers demo reference corpus clean
.SECONDARY: $(TEST_LIB)

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)

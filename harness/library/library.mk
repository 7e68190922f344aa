# The C library: a shared one that exports only the functions of beamwork.h, and a static one whose
# other symbols are local, so that they do not clash with other code.
SHARED := $(BUILD)/libbeamwork.so.0
STATIC := $(BUILD)/static/libbeamwork.a
LIBRARY_DOORS := $(patsubst %.c,$(BUILD)/%.o,$(sort $(wildcard harness/library/*.c)))
EXPORTS := harness/library/exports.map

.PHONY: library
# The C library: build/libbeamwork.so.0, build/static/libbeamwork.a.
library: $(SHARED) $(STATIC) $(TRUTHS)

$(SHARED): $(LIBRARY_DOORS) $(LIBRARY) $(EXPORTS)
	$(call SAY,link $@)$(CC) $(CFLAGS) -shared -Wl,-soname,$(@F) -Wl,--version-script=$(EXPORTS) -o $@ $(LIBRARY_DOORS) $(LIBRARY) $(LDFLAGS) $(DEP_LIBS)

$(STATIC): $(LIBRARY_DOORS) $(LIBRARY)
	@mkdir -p $(@D)
	$(call SAY,link $@)$(LD) -r -o $(@D)/beamwork.o $(LIBRARY_DOORS) $(LIBRARY)
	@objcopy --wildcard --keep-global-symbol='bw_*' $(@D)/beamwork.o
	@rm -f $@ && $(AR) rcs $@ $(@D)/beamwork.o

.PHONY: abi
# Checks that the C interface is still the committed one. ACCEPT=1: commits the present interface as the new one.
abi: $(SHARED)
	@harness/library/abi.sh $(SHARED) $(if $(ACCEPT),accept)

# Makes and frees objects a thousand times, for valgrind.
CYCLES := $(BUILD)/harness/library/test/cycles
lab-valgrind: $(CYCLES)
$(CYCLES): $(CYCLES).o $(LIBRARY)
	@$(CC) $(CFLAGS) -o $@ $^ $(LDFLAGS) $(DEP_LIBS)

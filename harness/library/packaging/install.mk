# make install DESTDIR= PREFIX=/usr/local: program, library, headers, data, examples, manual.
PREFIX ?= /usr/local
BINDIR ?= $(PREFIX)/bin
LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
SHAREDIR ?= $(PREFIX)/share
DATADIR := $(SHAREDIR)/beamwork
# Folder in which Debian's Python searches for modules of that prefix; for a prefix in a home folder it searches elsewhere.
PYTHONDIR ?= $(PREFIX)/lib/python$(if $(filter /usr,$(PREFIX)),3,$(shell $(PYTHON) -I -c 'import sys; print("%d.%d" % sys.version_info[:2])'))/$(if $(filter $(HOME)/.local,$(PREFIX)),site,dist)-packages

# Programs that are not next to their data search in this folder.
$(BUILD)/prefix: FORCE
	@mkdir -p $(@D); echo '$(DATADIR)' | cmp -s - $@ || echo '$(DATADIR)' >$@
$(BUILD)/harness/study/derive.o: $(BUILD)/prefix
$(BUILD)/harness/study/derive.o: DEFINES := -DBEAMWORK_DATA='"$(DATADIR)"'

.PHONY: install uninstall
install: all library man ## install into DESTDIR= PREFIX=/usr/local; LIBDIR=, BINDIR=, INCLUDEDIR=, SHAREDIR=, PYTHONDIR= where they differ
	@DESTDIR="$(DESTDIR)" PREFIX="$(PREFIX)" BINDIR="$(BINDIR)" LIBDIR="$(LIBDIR)" INCLUDEDIR="$(INCLUDEDIR)" SHAREDIR="$(SHAREDIR)" PYTHONDIR="$(PYTHONDIR)" \
		VERSION="$(VERSION)" LIBS="$(DEP_LIBS)" harness/library/packaging/install.sh "$(BUILD)"

# Removes the installed files; requires the same DESTDIR and PREFIX.
uninstall:
	@DESTDIR="$(DESTDIR)" PREFIX="$(PREFIX)" BINDIR="$(BINDIR)" LIBDIR="$(LIBDIR)" INCLUDEDIR="$(INCLUDEDIR)" SHAREDIR="$(SHAREDIR)" PYTHONDIR="$(PYTHONDIR)" \
		harness/library/packaging/uninstall.sh

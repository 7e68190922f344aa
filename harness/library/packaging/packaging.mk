# Additions to an installed copy: manual pages, and pages of the C interfaces.
.PHONY: man api
# Writes the manual pages to build/man; 'man -l build/man/beamwork.1' shows one.
man: all
	@mkdir -p $(BUILD)/man
	@for page in $$($(PROGRAM) help --man); do $(PROGRAM) help --man $$page >$(BUILD)/man/$$page || exit 1; done
	@for page in $(notdir $(wildcard harness/library/packaging/*.[0-9])); do harness/library/packaging/page.sh $$page $(VERSION) $(RELEASED) >$(BUILD)/man/$$page || exit 1; done

# Writes the pages of beamwork.h and element.h, build/api/index.html; requires doxygen.
api:
	@harness/library/packaging/api/pages.sh $(VERSION) $(BUILD)/api

.PHONY: wheel wheel-check
# Builds the wheel and the source distribution for pip, in build/wheel; with auditwheel and patchelf, for other systems, too.
wheel:
	@$(PYTHON) -B harness/library/packaging/build_backend.py $(BUILD)/wheel

# Installs both into new virtual environments and uses them; requires numpy from PyPI.
wheel-check: wheel
	@harness/library/packaging/wheel_check.sh $(BUILD)/wheel

.PHONY: deb deb-check
# Builds the Debian packages, build/deb/*.deb; as root, missing tools are installed.
deb:
	@harness/library/packaging/deb.sh $(VERSION) $(RELEASED) $(BUILD)/deb

# Checks the packages with lintian, and uses their contents from an empty tree.
deb-check: deb
	@harness/library/packaging/deb_check.sh $(BUILD)/deb

# What stands around an installed copy: manual pages, pages of the C interfaces.
.PHONY: man api
man: all ## write the manual pages: build/man; 'man -l build/man/beamwork.1' shows one
	@mkdir -p $(BUILD)/man
	@for page in $$($(PROGRAM) help --man); do $(PROGRAM) help --man $$page >$(BUILD)/man/$$page || exit 1; done
	@harness/packaging/element_page.sh $(VERSION) $(RELEASED) >$(BUILD)/man/beamwork-element.7

api: ## draw the pages of beamwork.h and element.h: build/api/index.html; needs doxygen
	@harness/packaging/api/pages.sh $(VERSION) $(BUILD)/api

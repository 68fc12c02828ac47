-- VPL in Neovim: the file type and the language server. Needs Neovim 0.7 or later and
-- `vpl` on the PATH. Load it with `dofile('/path/to/vpl/editors/neovim/vpl.lua')`.

vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
  pattern = '*.vpl',
  callback = function(event)
    vim.bo[event.buf].filetype = 'vpl'
    vim.bo[event.buf].commentstring = '// %s'
  end,
})

local client

vim.api.nvim_create_autocmd('FileType', {
  pattern = 'vpl',
  callback = function(event)
    client = client
      or vim.lsp.start_client({
        name = 'vpl',
        cmd = { vim.g.vpl_path or 'vpl', 'lsp' },
        root_dir = vim.fn.getcwd(),
        on_exit = function()
          client = nil
        end,
      })
    vim.lsp.buf_attach_client(event.buf, client)
  end,
})

-- For pages: figures get numbers, and \autoref{fig:...} names them, as LaTeX does by itself.

local number = {}
local count = 0

local function label_in(inlines)
  local found
  pandoc.walk_block(pandoc.Plain(inlines), {RawInline = function(raw)
    found = found or raw.text:match("^\\label{(.-)}")
  end})
  return found
end

local function number_figure(image)
  if image.title:sub(1, 4) ~= "fig:" then return nil end
  count = count + 1
  local label = label_in(image.caption)
  if label then number[label] = count end
  local caption = image.caption
  caption:insert(1, pandoc.Str("Figure " .. count .. ". "))
  image.caption = caption
  return image
end

local function resolve(raw)
  local label = raw.text:match("^\\autoref{(.-)}")
  if label then return pandoc.Str("Figure " .. assert(number[label], "no figure " .. label)) end
  return nil
end

return {{Image = number_figure}, {RawInline = resolve}}

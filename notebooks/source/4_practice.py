# %% [markdown]
# # 4 Practice
#
# Nothing here counts. A round takes ten minutes and asks questions from all three chapters: with other numbers, other
# statements, another order of the cards, or with three short functions to read. Each answer is marked at once, and a
# mistake is named. Come back tomorrow for another round.
#
# ## Five boxes
#
# Each question lies in one of five boxes. A right answer moves it one box up, a wrong one puts it back into box 1, and a
# question in one box is asked half as often as one in the box below. So you meet most often what you do not know yet,
# and what you know comes back now and then. (Only your first answer to a question moves it.) The method is from Sebastian
# Leitner, who used a shoe box with cards.
#
# A question that you have answered in its chapter begins in box 3 if you were right at the first attempt, and in box 1 if
# not; the others begin in box 2. Functions to read and formulas come only from questions that you have answered
# already, since they would tell the answer. The boxes are kept beside your answers.
#
# By keyboard: the Tab key goes from one control to the next, the space bar presses a button, arrow keys choose among
# answers, and Enter checks what you have typed.

# %%
practise()

# %% [markdown]
# The boxes are only as good as your honesty: decide on an answer before you press **Check**. If the same question comes
# back to box 1 again and again, open its chapter and read the section before it once more.

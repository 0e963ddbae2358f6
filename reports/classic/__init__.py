"""What becomes of each plugin of Gazebo Classic in the corpus, by `migrate-gazebo-classic`?"""

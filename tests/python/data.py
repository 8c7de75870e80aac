"""Makes the dataset that the other tests read; CTest runs it before them."""
import common

if __name__ == "__main__":
    print(common.dataset_folder())
